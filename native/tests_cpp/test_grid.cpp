// Robots on padded maps of cells.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "check.hpp"
#include "mrpbench_grid/cells.hpp"

using namespace mrpbench::grid;

namespace {

constexpr Place kHeight = 12, kWidth = 14, kMargin = 3;

/// Three maps with walls at random, and a ring around each.
std::vector<std::uint8_t> rooms() {
  std::vector<std::uint8_t> blocked(3 * kHeight * kWidth, 0);
  std::mt19937 random(4);
  for (Place map = 0; map < 3; ++map)
    for (Place row = kMargin - 1; row <= kHeight - kMargin; ++row)
      for (Place column = kMargin - 1; column <= kWidth - kMargin; ++column) {
        const bool ring = row < kMargin || row >= kHeight - kMargin || column < kMargin || column >= kWidth - kMargin;
        blocked[(map * kHeight + row) * kWidth + column] = ring || random() % 6 == 0;
      }
  return blocked;
}

bool inside(Place place) {
  const Place row = place / kWidth % kHeight, column = place % kWidth;
  return row >= kMargin && row < kHeight - kMargin && column >= kMargin && column < kWidth - kMargin;
}

}  // namespace

TEST("robots never share a cell or change places") {
  const auto blocked = rooms();
  Cells cells(blocked, kHeight, kWidth);
  std::mt19937 random(1);
  std::vector<Place> place;
  for (Place it = 0; it < static_cast<Place>(blocked.size()); ++it)
    if (inside(it) && !blocked[it] && random() % 3) place.push_back(it);
  std::ranges::shuffle(place, random);
  const std::size_t robots = place.size();
  const std::unique_ptr<bool[]> active(new bool[robots]);
  std::fill_n(active.get(), robots, true);
  constexpr std::array<Place, 5> offsets{0, -kWidth, kWidth, -1, 1};
  std::size_t moves = 0;
  for (int step = 0; step < 50; ++step) {
    std::vector<Place> wish = place, to(robots);
    for (Place& it : wish) it += offsets[random() % 5];
    cells.soft({active.get(), robots}, place, wish, to);
    std::vector<Place> before(blocked.size(), -1), sorted = to;
    for (std::size_t i = 0; i < robots; ++i) before[place[i]] = static_cast<Place>(i);
    std::ranges::sort(sorted);
    CHECK(std::ranges::adjacent_find(sorted) == sorted.end());
    for (std::size_t i = 0; i < robots; ++i) {
      const Place other = before[to[i]];
      CHECK(!blocked[to[i]] && (to[i] == place[i] || to[i] == wish[i]));
      CHECK(other < 0 || other == static_cast<Place>(i) || to[other] != place[i]);
      moves += to[i] != place[i];
    }
    place = to;
  }
  CHECK(moves > 10 * robots);
}

TEST("distances of neighbouring cells differ by one") {
  const auto blocked = rooms();
  Cells cells(blocked, kHeight, kWidth);
  const Place size = kHeight * kWidth;
  Place goal = size + 45;
  while (blocked[goal]) ++goal;
  std::vector<std::int32_t> steps(size);
  cells.distances(goal, steps);
  CHECK(steps[goal - size] == 0);
  for (Place it = 0; it < size; ++it) {
    if (blocked[size + it] || !inside(it)) {
      CHECK(steps[it] == unreachable);
      continue;
    }
    for (const Place next : {it + 1, it + kWidth})
      if (!blocked[size + next])
        CHECK(std::abs(steps[it] - steps[next]) == 1 || (steps[it] == unreachable && steps[next] == unreachable));
  }
}

TEST("windows show walls, robots and the goal") {
  const auto blocked = rooms();
  Cells cells(blocked, kHeight, kWidth);
  const std::array<Place, 2> place{3 * kWidth + 3, 4 * kWidth + 5}, goal{8 * kWidth + 10, 4 * kWidth + 4};
  const std::array<bool, 2> shown{false, true};
  std::vector<float> windows(2 * 3 * 49);
  cells.pogema(shown, place, goal, 3, windows);
  for (Place row = 0; row < 7; ++row)
    for (Place column = 0; column < 7; ++column) {
      const Place at = row * 7 + column;
      CHECK(windows[at] == blocked[row * kWidth + column]);
      CHECK(windows[49 + at] == (row == 4 && column == 5));
      CHECK(windows[98 + at] == (row == 6 && column == 6));
      CHECK(windows[147 + 98 + at] == (row == 3 && column == 2));
    }
}
