#include "mrpbench_grid/cells.hpp"

#include <algorithm>

namespace mrpbench::grid {

Cells::Cells(std::span<const std::uint8_t> blocked, Place height, Place width)
    : blocked_(blocked), height_(height), width_(width), occupant_(blocked.size(), -1), winner_(blocked.size(), -1) {}

void Cells::enter(std::span<const bool> active, std::span<const Place> place) {
  for (std::size_t i = 0; i < place.size(); ++i)
    if (active[i]) occupant_[place[i]] = static_cast<std::int32_t>(i);
}

void Cells::leave(std::span<const Place> place) {
  for (const Place it : place) occupant_[it] = -1;
}

std::size_t Cells::soft(std::span<const bool> active, std::span<const Place> place, std::span<const Place> wish,
                        std::span<Place> to) {
  const auto robots = static_cast<std::int32_t>(place.size());
  enter(active, place);
  stays_.resize(place.size());
  for (std::int32_t i = 0; i < robots; ++i) {
    stays_[i] = !active[i] || blocked_[wish[i]] || wish[i] == place[i];
    to[i] = stays_[i] ? place[i] : wish[i];
  }
  for (std::int32_t i = 0; i < robots; ++i) {
    if (stays_[i]) continue;
    const std::int32_t other = occupant_[to[i]];
    stays_[i] = other >= 0 && to[other] == place[i];  // they want to change places
  }
  for (std::int32_t i = 0; i < robots; ++i) {
    if (stays_[i]) continue;
    if (winner_[to[i]] < 0) {
      winner_[to[i]] = i;
    } else {
      stays_[i] = true;
    }
  }
  for (std::int32_t i = 0; i < robots; ++i) {
    if (!stays_[i] || !active[i]) continue;
    std::int32_t behind = winner_[place[i]];
    while (behind >= 0 && !stays_[behind]) {  // it wants the cell of a robot that stays
      stays_[behind] = true;
      behind = winner_[place[behind]];
    }
  }
  std::size_t refused = 0;
  for (std::int32_t i = 0; i < robots; ++i) {
    winner_[to[i]] = -1;
    if (stays_[i]) to[i] = place[i];
    refused += active[i] && to[i] != wish[i];
  }
  leave(place);
  return refused;
}

void Cells::overwritten(std::span<const bool> active, std::span<const Place> place, std::span<const Place> to,
                        std::span<bool> found) {
  enter(active, place);
  for (std::size_t i = 0; i < to.size(); ++i) found[i] = active[i] && occupant_[to[i]] > static_cast<std::int32_t>(i);
  leave(place);
}

void Cells::free_actions(std::span<const Place> place, std::span<std::uint8_t> bits) const {
  for (std::size_t i = 0; i < place.size(); ++i) {
    const std::uint8_t* const at = blocked_.data() + place[i];
    const int found =
        (at[0] ? 0 : 1) | (at[-width_] ? 0 : 2) | (at[width_] ? 0 : 4) | (at[-1] ? 0 : 8) | (at[1] ? 0 : 16);
    bits[i] = static_cast<std::uint8_t>(found);
  }
}

void Cells::distances(Place goal, std::span<std::int32_t> steps) {
  const Place size = height_ * width_, begin = goal - goal % size;
  const auto map = blocked_.subspan(begin, size);
  std::ranges::fill(steps, unreachable);
  queue_.resize(size);
  std::size_t first = 0, last = 0;
  queue_[last++] = static_cast<std::int32_t>(goal - begin);
  steps[goal - begin] = 0;
  while (first < last) {
    const std::int32_t at = queue_[first++];
    for (const Place offset : {-width_, width_, Place{-1}, Place{1}}) {
      const Place next = at + offset;
      if (next < 0 || next >= size || map[next] || steps[next] != unreachable) continue;
      steps[next] = steps[at] + 1;
      queue_[last++] = static_cast<std::int32_t>(next);
    }
  }
}

}  // namespace mrpbench::grid
