#include "mrpbench_slam/matching.hpp"

#include "mrpbench_common/wide.hpp"
#include "solve3.hpp"

namespace mrpbench::slam {

namespace {

constexpr int kSteps = 12;
/// Metres and radians below which a step ends the refinement.
constexpr double kStill = 1e-4;
/// Responses that say nothing about a distance.
constexpr double kFaint = 0.02;
/// Added to the matrix, which may otherwise be singular where nothing keeps to the odometry.
constexpr double kDamping = 1e-3;

MRPBENCH_WIDE void add(const std::uint8_t* from, std::uint32_t* to, int count) {
  for (int i = 0; i < count; ++i) to[i] += from[i];
}

/// Add the cells around `centre`, `half` to each side, to the sums.
void add_window(const Grid<std::uint8_t>& grid, Cell centre, int half, std::uint32_t* sums) {
  const Box& box = grid.box();
  const int width = 2 * half + 1;
  const int left = std::max(centre.column - half, box.low.column);
  const int right = std::min(centre.column + half + 1, box.high.column);
  const int bottom = std::max(centre.row - half, box.low.row), top = std::min(centre.row + half + 1, box.high.row);
  if (left >= right) return;
  for (int y = bottom; y < top; ++y) {
    std::uint32_t* to = sums + (y - centre.row + half) * width + (left - centre.column + half);
    add(grid.row(y) + (left - box.low.column), to, right - left);
  }
}

/// The equations of a Gauss-Newton step at a pose.
struct Step {
  double right[3] = {};
  double matrix[6] = {};  // xx, xy, xt, yy, yt, tt
};

Step step_at(const Field& field, const Scan& scan, Pose pose, Pose around, const Keeping& keeping) {
  Step found;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw), share = 1 / static_cast<double>(scan.returns.size());
  const double squares = field.deviation() * field.deviation();
  for (const Return& it : scan.returns) {
    const Response at = field.response(placed(pose, c, s, it.point));
    const double size = sim::length(at.slope);
    if (!(at.value > kFaint && size > 0)) continue;
    // Across the surface: along it, only the ends and gaps of what was seen so far would have an effect.
    const bool flat = it.normal.x != 0 || it.normal.y != 0;
    const Point across =
        flat ? Point{c * it.normal.x - s * it.normal.y, s * it.normal.x + c * it.normal.y} : at.slope * (1 / size);
    const double lever_x = -s * it.point.x - c * it.point.y, lever_y = c * it.point.x - s * it.point.y;
    const double row[3] = {across.x, across.y, across.x * lever_x + across.y * lever_y};
    const double weight = share * at.value / squares;
    const double distance = squares * dot(at.slope, across) / at.value;
    for (int i = 0; i < 3; ++i) found.right[i] += weight * distance * row[i];
    found.matrix[0] += weight * row[0] * row[0];
    found.matrix[1] += weight * row[0] * row[1];
    found.matrix[2] += weight * row[0] * row[2];
    found.matrix[3] += weight * row[1] * row[1];
    found.matrix[4] += weight * row[1] * row[2];
    found.matrix[5] += weight * row[2] * row[2];
  }
  const double by_place = 2 * keeping.translation * keeping.translation,
               by_turn = 2 * keeping.rotation * keeping.rotation;
  found.right[0] -= by_place * (pose.x - around.x);
  found.right[1] -= by_place * (pose.y - around.y);
  found.right[2] -= by_turn * wrapped(pose.yaw - around.yaw);
  found.matrix[0] += by_place + kDamping;
  found.matrix[3] += by_place + kDamping;
  found.matrix[5] += by_turn + kDamping;
  return found;
}

}  // namespace

std::vector<double> yaws_of(double yaw, const Window& window, double reach, double deviation) {
  const double step = reach > 0 ? std::min(window.step, 2 * deviation / reach) : window.step;
  const int count = static_cast<int>(std::ceil(window.turn / step - 1e-9));
  std::vector<double> yaws;
  for (int i = -count; i <= count; ++i) yaws.push_back(yaw + i * step);
  return yaws;
}

Match CorrelativeSearch::best(const Field& field, const Scan& scan, Pose around, const Window& window,
                              const Keeping& keeping) {
  const double per_metre = 1 / field.resolution();
  const int half = static_cast<int>(std::lround(window.half * per_metre)), width = 2 * half + 1;
  const double share = 1 / (255.0 * static_cast<double>(scan.returns.size()));
  Match best{around, 0};
  double highest = -1e300;
  for (const double yaw : yaws_of(around.yaw, window, scan.reach(), field.deviation())) {
    sums_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(width), 0);
    const double c = std::cos(yaw), s = std::sin(yaw);
    for (const Return& it : scan.returns) {
      const Point at = placed(around, c, s, it.point) * per_metre;
      add_window(field.grid(), {floor_index(at.x), floor_index(at.y)}, half, sums_.data());
    }
    for (int j = 0; j < width; ++j) {
      for (int i = 0; i < width; ++i) {
        const double dx = (i - half) * field.resolution(), dy = (j - half) * field.resolution();
        const double response = share * sums_[static_cast<std::size_t>(j * width + i)];
        const double score = response - keeping.penalty(dx * dx + dy * dy, yaw - around.yaw);
        if (score <= highest) continue;
        highest = score;
        best = {{around.x + dx, around.y + dy, wrapped(yaw)}, response};
      }
    }
  }
  return best;
}

Match refined(const Field& field, const Scan& scan, Pose start, Pose around, const Keeping& keeping) {
  Pose pose = start;
  for (int count = 0; count < kSteps; ++count) {
    const Step step = step_at(field, scan, pose, around, keeping);
    double move[3];
    if (!solve3(step.matrix, step.right, move)) break;
    const double largest = std::max({std::abs(move[0]), std::abs(move[1]), std::abs(move[2])});
    const double factor = std::min(1.0, field.deviation() / std::max(largest, kStill));
    pose = {pose.x + factor * move[0], pose.y + factor * move[1], wrapped(pose.yaw + factor * move[2])};
    if (largest < kStill) break;
  }
  return {pose, response_of(field, scan, pose)};
}

double response_of(const Field& field, const Scan& scan, Pose pose) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  double sum = 0;
  for (const Return& it : scan.returns) sum += field.response(placed(pose, c, s, it.point)).value;
  return scan.returns.empty() ? 0 : sum / static_cast<double>(scan.returns.size());
}

Information information_of(const Field& field, const Scan& scan, Pose pose) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw), per_square = 1 / (field.deviation() * field.deviation());
  Information sum{};
  for (const Return& it : scan.returns) {
    const double weight = per_square * field.response(placed(pose, c, s, it.point)).value;
    const double row[3] = {it.normal.x, it.normal.y, it.normal.y * it.point.x - it.normal.x * it.point.y};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) sum[3 * i + j] += weight * row[i] * row[j];
    }
  }
  return sum;
}

}  // namespace mrpbench::slam
