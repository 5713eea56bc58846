// Tables of large maps, and the budget of tables.
#include <algorithm>
#include <random>
#include <vector>

#include "check.hpp"
#include "discrete/landmarks.hpp"
#include "mrpbench_discrete/distance_tables.hpp"

using namespace mrpbench::discrete;

namespace {

/// Four by three clusters with long walls and single blocked cells.
Grid rooms() {
  constexpr int kHeight = 90, kWidth = 110;
  std::vector<std::uint8_t> blocked(kHeight * kWidth, 0);
  std::mt19937 random(3);
  for (auto& it : blocked) it = random() % 5 == 0;
  for (int row = 0; row < kHeight; ++row) blocked[row * kWidth + 50] = row != 71;
  for (int column = 0; column < kWidth; ++column) blocked[40 * kWidth + column] = column != 20 && column != 90;
  return {blocked, kHeight, kWidth};
}

std::vector<int> moves_to(const Grid& grid, int goal) {
  std::vector<int> found(grid.size(), -1), queue{goal};
  found[goal] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int heading = 0; heading < 4; ++heading) {
      const int near = grid.ahead(queue[i], heading);
      if (near < 0 || found[near] >= 0) continue;
      found[near] = found[queue[i]] + 1;
      queue.push_back(near);
    }
  }
  return found;
}

}  // namespace

TEST("costs by clusters lead from every cell to the goal and are near the true ones") {
  const Grid grid = rooms();
  DistanceTables tables(grid, 1 << 20, true);
  double sum = 0, least = 0;
  for (const int goal : {0, 77, grid.size() / 2, grid.size() - 1}) {
    const auto moves = moves_to(grid, goal);
    const DistanceTable& table = tables.to(goal);
    for (int cell = 0; cell < grid.size(); ++cell) {
      const std::uint32_t cost = table.from(cell);
      CHECK((moves[cell] < 0) == (cost == DistanceTable::unreachable));
      if (moves[cell] <= 0) continue;
      CHECK(cost >= static_cast<std::uint32_t>(moves[cell]));
      sum += cost;
      least += moves[cell];
      bool descends = false;
      for (int heading = 0; heading < 4; ++heading) {
        const int near = grid.ahead(cell, heading);
        descends |= near >= 0 && table.from(near) < cost;
        const std::uint32_t turned = table.from(Pose{cell, heading});
        CHECK(turned >= cost && turned <= cost + 2);
      }
      CHECK(descends);
    }
    CHECK(table.from(goal) == 0);
  }
  CHECK(sum < 1.1 * least);
}

TEST("the heading of the next move costs no turn") {
  const std::vector<std::uint8_t> blocked(100, 0);
  const Grid grid(blocked, 1, 100);
  DistanceTables tables(grid, 1 << 20, true);
  for (const int cell : {10, 31, 32, 40, 63, 64}) {
    CHECK(tables.to(99).from(Pose{cell, 0}) == static_cast<std::uint32_t>(99 - cell));
    CHECK(tables.to(99).from(Pose{cell, 1}) == static_cast<std::uint32_t>(99 - cell) + 1);
    CHECK(tables.to(99).from(Pose{cell, 2}) == static_cast<std::uint32_t>(99 - cell) + 2);
  }
}

TEST("landmarks bound the moves from below, by no less than the Manhattan distance") {
  const Grid grid = rooms();
  const int goal = grid.size() / 3;
  const Landmarks landmarks(grid, goal);
  const auto moves = moves_to(grid, goal);
  for (int cell = 0; cell < grid.size(); ++cell) {
    if (moves[cell] < 0) continue;
    CHECK(landmarks.bound(cell, goal) <= static_cast<std::uint32_t>(moves[cell]));
    CHECK(landmarks.bound(cell, goal) >= static_cast<std::uint32_t>(grid.manhattan(cell, goal)));
  }
}

/// Costs change several times, and not every goal is asked for in between.
TEST("values do not depend on the budget") {
  const Grid grid = rooms();
  for (const bool clustered : {false, true}) {
    DistanceTables all(grid, 1 << 24, clustered), one(grid, 0, clustered);
    std::mt19937 random(5);
    for (int round = 0; round < 60; ++round) {
      const int goal = static_cast<int>(random() % 7) * 100, cell = static_cast<int>(random() % grid.size());
      const Pose pose{cell, static_cast<int>(random() % 4)};
      CHECK(all.to(goal).from(pose) == one.to(goal).from(pose));
      CHECK(one.full());
      const std::size_t cells = random() % (2 * grid.size());
      if (clustered) continue;
      const bool done = all.refresh(cells);
      CHECK(done == one.refresh(cells));
      if (round % 8 != 7) continue;
      Costs costs{2, std::vector<std::uint8_t>(4 * grid.size())};
      for (auto& it : costs.forward) it = static_cast<std::uint8_t>(1 + random() % 9);
      all.set_costs(costs);
      one.set_costs(costs);
    }
    CHECK(!all.full());
  }
}
