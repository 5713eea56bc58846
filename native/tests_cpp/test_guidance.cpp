// Costs from traffic, and tables that follow them.
#include <algorithm>
#include <vector>

#include "check.hpp"
#include "discrete/guidance.hpp"

using namespace mrpbench::discrete;

namespace {

constexpr int kWidth = 5;

/// Three rows of five cells; only the ends of the middle row are free.
Grid two_ways() {
  std::vector<std::uint8_t> blocked(3 * kWidth, 0);
  for (int column = 1; column < kWidth - 1; ++column) blocked[kWidth + column] = 1;
  return {blocked, 3, kWidth};
}

}  // namespace

TEST("opposite traffic and robots that stay make a way longer, the same direction does not") {
  const Grid grid = two_ways();
  const int west = grid.free_cell(0), east = grid.free_cell(kWidth - 1), middle = grid.free_cell(2);
  DistanceTables tables(grid, 1 << 20);
  Guidance guidance(grid, tables);
  const std::uint32_t turn = tables.turn();
  CHECK(tables.to(east).from(Pose{west, 0}) == 4 * turn);
  for (int step = 0; step < 40; ++step) {
    guidance.observe({{middle, 2}}, {Action::forward});
    guidance.update();
  }
  CHECK(tables.to(east).from(Pose{west, 0}) > 5 * turn);
  CHECK(tables.to(west).from(Pose{east, 2}) == 4 * turn);
  for (int step = 0; step < 80; ++step) {
    guidance.observe({{middle, 2}}, {Action::clockwise});
    guidance.update();
  }
  CHECK(tables.to(west).from(Pose{east, 2}) > 5 * turn);
}

TEST("tables keep their costs until they are refreshed, a few at a time") {
  const Grid grid = two_ways();
  DistanceTables tables(grid, 1 << 20);
  const auto dear = [&](int goal) { return tables.to(goal).from(grid.free_cell(1)) > 4; };
  tables.to(0);
  tables.to(4);
  tables.set_costs({1, std::vector<std::uint8_t>(4 * grid.size(), 9)});
  CHECK(dear(2));
  CHECK(!dear(0) && !dear(4));
  const std::size_t size = grid.size();
  CHECK(!tables.refresh(size / 2));
  CHECK(!dear(0) && !dear(4));
  CHECK(!tables.refresh(size));
  CHECK(dear(0) != dear(4));
  CHECK(tables.refresh(size));
  CHECK(dear(0) && dear(4));
}

/// Turns that cost more than one move, and moves of several costs: compared with a search over all poses.
TEST("tables hold the exact costs of poses") {
  const Grid grid = two_ways();
  Costs costs{Costs::most_turn, std::vector<std::uint8_t>(4 * grid.size(), 1)};
  for (std::size_t i = 0; i < costs.forward.size(); ++i) costs.forward[i] = static_cast<std::uint8_t>(1 + (7 * i) % 11);
  DistanceTables tables(grid, 1 << 20);
  tables.set_costs(costs);
  const int goal = 6;
  std::vector<std::uint32_t> least(4 * grid.size(), 1000);
  for (int heading = 0; heading < 4; ++heading) least[4 * goal + heading] = 0;
  for (int round = 0; round < 4 * grid.size(); ++round) {
    for (int state = 0; state < 4 * grid.size(); ++state) {
      const int cell = state / 4, heading = state % 4, ahead = grid.ahead(cell, heading);
      std::uint32_t& own = least[state];
      own = std::min(
          {own, least[4 * cell + (heading + 1) % 4] + costs.turn, least[4 * cell + (heading + 3) % 4] + costs.turn});
      if (ahead >= 0) own = std::min(own, least[4 * ahead + heading] + costs.forward[state]);
    }
  }
  for (int state = 0; state < 4 * grid.size(); ++state) {
    CHECK(tables.to(goal).from(Pose{state / 4, state % 4}) == least[state]);
  }
}
