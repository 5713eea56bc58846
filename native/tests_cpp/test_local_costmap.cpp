#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "check.hpp"
#include "mrpbench_local/costmap/beams.hpp"
#include "mrpbench_local/costmap/cell_set.hpp"
#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/costmap/footprint.hpp"

using namespace mrpbench::local;

namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

CostmapOptions options() {
  CostmapOptions result;
  result.footprint = padded(rounded(0.1), 0.01);
  return result;
}

std::vector<double> scan(double range) {
  return std::vector<double>(360, range);
}

int count(const Costmap& map, std::uint8_t cost) {
  int found = 0;
  for (const std::uint8_t it : map.costs()) found += it == cost;
  return found;
}

}  // namespace

TEST("a set of cells is one of pairs of numbers, also when it moves") {
  std::mt19937 draw(3);
  const auto below = [&](int most) { return static_cast<int>(draw() % static_cast<unsigned>(most)); };
  for (int round = 0; round < 200; ++round) {
    const Frame frame{1 + below(round % 2 ? 150 : 70), 1 + below(30), 0.05, {0, 0}};
    CellSet cells, others;
    cells.begin(frame);
    others.begin(frame);
    std::set<std::pair<int, int>> wanted;  // by row and column
    for (int i = below(300); i > 0; --i) {
      const Cell c{below(frame.width), below(frame.height)};
      if (i % 3 == 0) {
        cells.erase(c);
        wanted.erase({c.y, c.x});
      } else {
        cells.insert(c);
        wanted.insert({c.y, c.x});
      }
    }
    const Cell by{below(2 * frame.width + 1) - frame.width, round % 5 ? below(7) - 3 : 0};
    cells.move(by);
    std::set<std::pair<int, int>> moved;
    for (const auto& [y, x] : wanted) {
      if (frame.holds({x + by.x, y + by.y})) moved.insert({y + by.y, x + by.x});
    }
    std::vector<std::pair<int, int>> all;
    cells.each([&](Cell c) { all.push_back({c.y, c.x}); });
    CHECK((all == std::vector<std::pair<int, int>>(moved.begin(), moved.end())));
    for (int y = 0; y < frame.height; ++y) {
      const int x = below(frame.width + 1);
      int in = x, out = x;
      while (in < frame.width && !moved.contains({y, in})) ++in;
      while (out < frame.width && moved.contains({y, out})) ++out;
      CHECK(cells.next_in(x, y) == in && cells.next_out(x, y) == out);
    }
    others.insert({0, 0});
    cells.insert(others);
    bool first = false;
    cells.each_not_in(others, [&](Cell c) { first = first || c == Cell{0, 0}; });
    CHECK(cells.holds({0, 0}) && !first);
  }
}

TEST("padded discs have the inscribed radii of Nav2") {
  CHECK(std::abs(inscribed_radius(padded(rounded(0.1), 0.01)) - 0.1078) < 1e-4);
  CHECK(std::abs(inscribed_radius(padded(rounded(0.22), 0.01)) - 0.2255) < 1e-4);
}

TEST("costs follow Nav2's formula") {
  CHECK(inflated_cost(0, 0.1, 3) == 254);
  CHECK(inflated_cost(0.1, 0.1, 3) == 253);
  CHECK(inflated_cost(0.3, 0.1, 3) == static_cast<std::uint8_t>(252 * std::exp(-0.6)));
}

TEST("inflated costs are those of the distance to the nearest lethal cell, also next to solid blocks and the border") {
  CostmapOptions plain = options(), inflated = options();
  plain.inflation_layer = false;
  Costmap marks(plain, nullptr), map(inflated, nullptr);
  for (int k = 0; k < 20; ++k) {  // walls that thicken as the robot comes nearer, and specks
    std::vector<double> ranges = scan(1.2);
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] += i % 7 == 0 ? -0.1 * (k % 5) : i < 90 ? 0.3 : 0;
    const Pose pose{0.01 * k, 0.02 * k, 0.1 * k};
    for (Costmap* it : {&marks, &map}) {
      it->see(pose, {}, ranges);
      it->update(pose);
    }
  }
  const Frame& frame = map.frame();
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      double nearest = HUGE_VAL;
      for (int v = 0; v < frame.height; ++v) {
        for (int u = 0; u < frame.width; ++u) {
          if (marks.at({u, v}) == kLethal) nearest = std::min(nearest, std::hypot(u - x, v - y) * frame.resolution);
        }
      }
      const bool far = nearest > inflated.inflation_radius + 1e-9;
      CHECK(map.at({x, y}) == (far ? kFree : inflated_cost(nearest, map.inscribed(), inflated.cost_scaling_factor)));
    }
  }
}

TEST("a scan marks where its beams end, and the next one clears the cells that its beams pass") {
  CostmapOptions plain = options();
  plain.inflation_layer = false;
  Costmap map(plain, nullptr);
  map.see({0, 0, 0}, {}, scan(1.0));
  map.update({0, 0, 0});
  const Frame& frame = map.frame();
  CHECK(map.at(frame.cell({1.0, 0.0})) == 254);
  CHECK(map.at(frame.cell({0.0, 1.0})) == 254);
  CHECK(map.at(frame.cell({0.5, 0.0})) == 0);
  const int marked = count(map, 254);
  CHECK(marked > 90 && marked < 200);
  map.see({0, 0, 0}, {}, scan(kNothing));
  map.update({0, 0, 0});
  CHECK(count(map, 254) == marked);
  map.see({0, 0, 0}, {}, scan(1.4));
  map.update({0, 0, 0});
  CHECK(map.at(frame.cell({1.0, 0.0})) == 0);
  CHECK(map.at(frame.cell({1.4, 0.0})) == 254);
  map.clear();
  CHECK(count(map, 254) == 0);
}

TEST("a line passes through the cells along which it is walked, and no others") {
  for (int x = -7; x <= 7; ++x) {
    for (int y = -7; y <= 7; ++y) {
      std::vector<Cell> along;
      line({2, 3}, {2 + x, 3 + y}, [&](Cell c) { return along.push_back({c.x - 2, c.y - 3}), true; });
      for (int u = -8; u <= 8; ++u) {
        for (int v = -8; v <= 8; ++v) {
          CHECK(Line({2, 3}, {2 + x, 3 + y}).holds({u, v}) == (std::ranges::count(along, Cell{u, v}) > 0));
        }
      }
    }
  }
}

TEST("a scan clears what its beams pass and marks where they end, as if they were walked along") {
  CostmapOptions plain = options();
  plain.inflation_layer = plain.footprint_clearing = false;
  Costmap map(plain, nullptr);
  const Frame& frame = map.frame();
  std::vector<std::uint8_t> expected(frame.size(), kFree);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> range(0.1, 3.0), turn(-3, 3);
  for (int k = 0; k < 40; ++k) {
    std::vector<double> ranges = scan(range(random));
    for (std::size_t i = 0; i < ranges.size(); ++i)
      ranges[i] = i % 40 < 20 ? range(random) : i % 97 ? ranges[i] : kNothing;
    const Pose pose{0.0005 * k, -0.0005 * k, turn(random)};  // the frame stays
    map.see(pose, {{-0.03, 0}, 3.5}, ranges);
    map.update(pose);
    const Point origin{pose.x - 0.03 * std::cos(pose.yaw), pose.y - 0.03 * std::sin(pose.yaw)};
    Beams beams;
    beams.aim(ranges.size(), origin, pose.yaw);
    std::vector<double> lengths(ranges.size());
    std::vector<Cell> ends(ranges.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) lengths[i] = std::isfinite(ranges[i]) ? ranges[i] : -1;
    beams.clip(frame, lengths);
    beams.end_cells(frame, lengths, ends);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (lengths[i] < 0) continue;
      const Cell end{std::clamp(ends[i].x, 0, frame.width - 1), std::clamp(ends[i].y, 0, frame.height - 1)};
      line(frame.cell(origin), end, [&](Cell c) { return expected[frame.index(c)] = kFree, true; });
    }
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const Cell end = frame.cell(beams.end(i, ranges[i] < 2.5 ? ranges[i] : 0));
      if (ranges[i] < 2.5 && frame.holds(end)) expected[frame.index(end)] = kLethal;
    }
    CHECK(map.costs() == expected);
  }
}

TEST("cells by products are those by divisions, also of points on borders of cells") {
  Frame frame{60, 60, 0.05, {-30, 7}};
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-40, 40);
  for (int k = 0; k < 2000; ++k) {
    const double x = k % 3 ? place(random) : 0.05 * std::round(place(random)), y = place(random);
    const Cell divided{static_cast<int>(std::floor(x / 0.05)) + 30, static_cast<int>(std::floor(y / 0.05)) - 7};
    Cell found;
    frame.cells(1, [&](std::size_t) { return Point{x, y}; }, [&](std::size_t, Cell c) { found = c; });
    CHECK(found == divided);
  }
}

TEST("beams without a return clear only if inf_is_valid is set") {
  CostmapOptions plain = options();
  plain.inflation_layer = false;
  plain.inf_is_valid = true;
  Costmap map(plain, nullptr);
  map.see({0, 0, 0}, {{0, 0}, 3.5}, scan(1.0));
  map.update({0, 0, 0});
  map.see({0, 0, 0}, {{0, 0}, 3.5}, scan(kNothing));
  map.update({0, 0, 0});
  CHECK(count(map, 254) == 0);
}

TEST("returns beyond the range are not marked") {
  CostmapOptions plain = options();
  plain.inflation_layer = false;
  plain.obstacle_max_range = 0.9;
  Costmap map(plain, nullptr);
  map.see({0, 0, 0}, {}, scan(1.0));
  map.update({0, 0, 0});
  CHECK(count(map, 254) == 0);
}

TEST("marks stay where they are while the map rolls, until they leave it") {
  CostmapOptions plain = options();
  plain.inflation_layer = false;
  Costmap map(plain, nullptr);
  std::vector<double> one(360, kNothing);
  one[0] = 1.0;
  map.see({0, 0, 0}, {}, one);
  map.update({0, 0, 0});
  for (const double x : {0.3, 0.77, 2.4}) {
    map.update({x, 0.2, 1.0});
    CHECK(map.at(map.frame().cell({1.0, 0.001})) == 254);
    CHECK(count(map, 254) == 1);
  }
  map.update({2.6, 0.2, 1.0});
  CHECK(count(map, 254) == 0);
}

TEST("nothing is marked under the robot") {
  CostmapOptions plain = options();
  plain.inflation_layer = false;
  Costmap map(plain, nullptr);
  map.see({0, 0, 0}, {}, scan(0.04));
  map.update({0, 0, 0});
  CHECK(count(map, 254) == 0);
}

TEST("the static layer contains the walls nearby") {
  CostmapOptions plain = options();
  plain.inflation_layer = false;
  plain.static_layer = true;
  const auto walls = std::make_shared<const StaticMap>(std::vector<Segment>{{{-9, 0.52}, {9, 0.52}}}, 4.3);
  Costmap map(plain, walls);
  map.update({0, 0, 0});
  CHECK(count(map, 254) == 60);
  CHECK(map.at(map.frame().cell({0.7, 0.52})) == 254);
  map.clear();
  map.update({0, 0, 0});
  CHECK(count(map, 254) == 60);
}

TEST("a robot may be where its inscribed circle is clear of what beams hit, though a cell nearby is marked") {
  CostmapOptions plain = options();  // 0.1078 m
  std::vector<double> one(360, kNothing);
  one[0] = 0.149;  // marks the cell from 0.10 to 0.15
  Costmap map(plain, nullptr);
  map.see({0.001, 0.001, 0}, {}, one);
  map.update({0.001, 0.001, 0});
  const auto free = [&](double x) { return map.is_free(map.frame().cell({x, 0.001}), {x, 0.001}); };
  CHECK(map.at(map.frame().cell({0.041, 0.001})) == kInscribed);
  CHECK(free(0.041) && !free(0.043));
}

TEST("a robot that is too close to something may come no closer, and may leave") {
  CostmapOptions close = options();
  close.footprint_clearing = false;
  std::vector<double> one(360, kNothing);
  one[0] = 0.09;
  Costmap map(close, nullptr);
  map.see({0.001, 0.001, 0}, {}, one);
  map.update({0.001, 0.001, 0});
  const auto free = [&](double x, double y) { return map.is_free(map.frame().cell({x, y}), {x, y}); };
  CHECK(free(0.001, 0.001) && free(-0.03, 0.001) && free(0.001, 0.03));
  CHECK(!free(0.01, 0.001));
  map.update({-0.5, 0.001, 0});
  CHECK(!free(0.001, 0.001));
}
