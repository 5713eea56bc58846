#include "operations.hpp"

#include <algorithm>

namespace mrpbench::discrete {
namespace {

bool sound(const Operation& operation) {
  using enum Action;
  for (std::size_t i = 0; i < operation.size(); ++i) {
    if (operation[i] == forward || operation[i] == wait) continue;
    if (i + 1 == operation.size()) return false;
    const Action next = operation[i + 1];
    if (next == forward) continue;
    const bool half_turn = operation[i] == clockwise && next == clockwise;
    if (!half_turn || (i > 0 && operation[i - 1] == clockwise)) return false;
  }
  return true;
}

int earliness(const Operation& operation) {
  int found = 0, worth = 1;
  for (auto it = operation.rbegin(); it != operation.rend(); ++it, worth *= 2)
    found += *it == Action::forward ? worth : 0;
  return found;
}

}  // namespace

std::vector<Operation> operations(int depth) {
  using enum Action;
  std::vector<Operation> found, open{{}};
  for (int i = 0; i < depth; ++i) {
    std::vector<Operation> longer;
    for (const Operation& it : open) {
      for (const Action action : {wait, clockwise, counter_clockwise, forward}) {
        longer.push_back(it);
        longer.back().push_back(action);
      }
    }
    open = std::move(longer);
  }
  for (Operation& it : open) {
    if (sound(it)) found.push_back(std::move(it));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Operation& a, const Operation& b) { return earliness(a) < earliness(b); });
  return found;
}

}  // namespace mrpbench::discrete
