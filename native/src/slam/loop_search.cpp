#include "mrpbench_slam/loop_search.hpp"

namespace mrpbench::slam {

namespace {

constexpr std::size_t kMostLevels = 6;

/// The cells of a scan at one yaw, at the middle of the window.
struct Turned {
  double yaw = 0;
  std::vector<Cell> cells;
};

/// The maxima of squares twice as wide as those of `finer`, whose sides are `step` cells.
Grid<std::uint8_t> of_squares(const Grid<std::uint8_t>& finer, int step) {
  Grid<std::uint8_t> coarse;
  const Box& box = finer.box();
  if (box.columns() == 0) return coarse;
  coarse.cover(box);
  for (int y = box.low.row; y < box.high.row; ++y) {
    const std::uint8_t *below = finer.row(y), *above = finer.row(y + step < box.high.row ? y + step : y);
    std::uint8_t* to = coarse.row(y);
    for (int x = 0; x < box.columns(); ++x) to[x] = std::max(below[x], above[x]);
    for (int x = 0; x + step < box.columns(); ++x) to[x] = std::max(to[x], to[x + step]);
  }
  return coarse;
}

}  // namespace

/// The offsets of a square of `1 << level` cells to each side, at one yaw.
struct LoopSearch::Node {
  std::size_t yaw = 0, level = 0;
  Cell offset;
  double bound = 0, response = 0;
};

struct LoopSearch::Search {
  std::vector<Turned> turned;
  int half = 0;
  double resolution = 0, yaw = 0, share = 0, least = 0;
  Keeping keeping;

  /// The least penalty in a square of offsets.
  double penalty(const Node& node) const {
    const int size = 1 << node.level;
    const auto nearest = [&](int low) { return low > 0 ? low : std::min(0, low + size - 1); };
    const double dx = nearest(node.offset.column - half) * resolution,
                 dy = nearest(node.offset.row - half) * resolution;
    return keeping.penalty(dx * dx + dy * dy, turned[node.yaw].yaw - yaw);
  }
};

LoopSearch::LoopSearch(Field field, double half) : field_(std::move(field)) {
  const Grid<std::uint8_t>* finer = &field_.grid();
  maxima_.reserve(kMostLevels);
  for (std::size_t level = 1; level <= kMostLevels && (1 << (level - 1)) * field_.resolution() < half; ++level) {
    maxima_.push_back(of_squares(*finer, 1 << (level - 1)));
    finer = &maxima_.back();
  }
}

std::uint8_t LoopSearch::maximum(std::size_t level, Cell it) const {
  if (level == 0) return field_.grid().value(it);
  // A square that begins outside of the grid holds no more than the one that begins at its edge.
  const Box& box = field_.grid().box();
  const int size = 1 << level;
  if (it.column + size <= box.low.column || it.row + size <= box.low.row) return 0;
  return maxima_[level - 1].value({std::max(it.column, box.low.column), std::max(it.row, box.low.row)});
}

void LoopSearch::descend(const Search& search, const Node& node, Node& best, double& highest) const {
  if (node.bound <= highest || node.response < search.least) return;
  if (node.level == 0) {
    best = node;
    highest = node.bound;
    return;
  }
  std::array<Node, 4> children;
  std::size_t count = 0;
  const int step = 1 << (node.level - 1);
  for (int part = 0; part < 4; ++part) {
    Node child{node.yaw, node.level - 1, {node.offset.column + (part % 2) * step, node.offset.row + (part / 2) * step}};
    if (child.offset.column > 2 * search.half || child.offset.row > 2 * search.half) continue;
    std::uint32_t sum = 0;
    for (const Cell& it : search.turned[node.yaw].cells) {
      sum += maximum(child.level, {it.column + child.offset.column, it.row + child.offset.row});
    }
    child.response = search.share * sum;
    child.bound = child.response - search.penalty(child);
    children[count++] = child;
  }
  std::stable_sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count),
                   [](const Node& a, const Node& b) { return a.bound > b.bound; });
  for (std::size_t i = 0; i < count; ++i) descend(search, children[i], best, highest);
}

std::optional<Match> LoopSearch::best(const Scan& scan, Pose around, const Window& window, const Keeping& keeping,
                                      double least) const {
  if (scan.returns.empty()) return {};
  const double per_metre = 1 / field_.resolution();
  Search search;
  search.half = static_cast<int>(std::lround(window.half * per_metre));
  search.resolution = field_.resolution();
  search.yaw = around.yaw;
  search.share = 1 / (255.0 * static_cast<double>(scan.returns.size()));
  search.keeping = keeping;
  search.least = least;
  for (const double yaw : yaws_of(around.yaw, window, scan.reach(), field_.deviation())) {
    Turned turned{yaw, {}};
    const double c = std::cos(yaw), s = std::sin(yaw);
    for (const Return& it : scan.returns) {
      const Point at = placed(around, c, s, it.point) * per_metre;
      turned.cells.push_back({floor_index(at.x) - search.half, floor_index(at.y) - search.half});
    }
    search.turned.push_back(std::move(turned));
  }
  const std::size_t top = maxima_.size();
  std::vector<Node> roots;
  for (std::size_t yaw = 0; yaw < search.turned.size(); ++yaw) {
    for (int y = 0; y <= 2 * search.half; y += 1 << top) {
      for (int x = 0; x <= 2 * search.half; x += 1 << top) {
        Node root{yaw, top, {x, y}};
        std::uint32_t sum = 0;
        for (const Cell& it : search.turned[yaw].cells) sum += maximum(top, {it.column + x, it.row + y});
        root.response = search.share * sum;
        root.bound = root.response - search.penalty(root);
        roots.push_back(root);
      }
    }
  }
  std::stable_sort(roots.begin(), roots.end(), [](const Node& a, const Node& b) { return a.bound > b.bound; });
  constexpr double kNothing = -1e300;
  Node best;
  double highest = kNothing;
  for (const Node& root : roots) descend(search, root, best, highest);
  if (highest == kNothing) return {};
  const Pose pose{around.x + (best.offset.column - search.half) * search.resolution,
                  around.y + (best.offset.row - search.half) * search.resolution, wrapped(search.turned[best.yaw].yaw)};
  return Match{pose, best.response};
}

}  // namespace mrpbench::slam
