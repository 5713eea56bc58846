#include "mrpbench_mapf/cbs/low_level/focal_queue.hpp"

#include <algorithm>
#include <bit>

namespace mrpbench::mapf {

void FocalQueue::reset(Tick least_f, Tick bound) {
  for (int row = 0; row < used_rows_; ++row) {
    for (std::size_t word = 0; word < rows_[row].mask.size(); ++word) {
      for (std::uint64_t& mask = rows_[row].mask[word]; mask != 0; mask &= mask - 1) {
        rows_[row].cells[word * 64 + std::countr_zero(mask)].clear();
      }
    }
  }
  for (std::size_t place = 0; place < open_.size(); ++place) waiting_[place].clear();
  used_rows_ = 0;
  first_row_ = kRows;
  open_.clear();
  base_ = least_ = least_f;
  bound_ = bound;
  size_ = 0;
}

Tick FocalQueue::least_f() {
  while (open_[least_ - base_] == 0) ++least_;
  return least_;
}

void FocalQueue::raise(Tick bound) {
  for (Tick f = bound_ + 1; f <= bound && f - base_ < static_cast<Tick>(open_.size()); ++f) {
    for (const Waiting& it : waiting_[f - base_]) enter(it);
    waiting_[f - base_].clear();
  }
  bound_ = std::max(bound_, bound);
}

}  // namespace mrpbench::mapf
