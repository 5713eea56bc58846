#include "mrpbench_mapf/cbs/low_level/focal_queue.hpp"

#include <algorithm>
#include <utility>

namespace mrpbench::mapf {

void FocalQueue::reset(Tick least_f, Tick bound) {
  links_.clear();
  for (int row = 0; row < used_rows_; ++row) {
    rows_[row].head.clear();
    rows_[row].mask.clear();
  }
  used_rows_ = 0;
  first_row_ = kRows;
  far_.clear();
  count_.clear();
  base_ = least_ = least_f;
  bound_ = bound;
  size_ = 0;
}

void FocalQueue::push(std::int32_t node, Tick f, int row, int column) {
  if (static_cast<std::size_t>(node) >= links_.size()) links_.resize(node + 1);
  links_[node] = {f, std::min(row, kRows - 1), column, kNone, kNone};
  const auto place = static_cast<std::size_t>(f - base_);
  if (place >= count_.size()) {
    count_.resize(place + 1, 0);
    far_.resize(place + 1, kNone);
  }
  ++count_[place];
  ++size_;
  enter(node);
}

void FocalQueue::update(std::int32_t node, int row, int column) {
  leave(node);
  links_[node].row = std::min(row, kRows - 1);
  links_[node].column = column;
  enter(node);
}

std::int32_t FocalQueue::pop() {
  for (;; ++first_row_) {
    Row& row = rows_[first_row_];
    while (row.first < row.mask.size() && row.mask[row.first] == 0) ++row.first;
    if (row.first >= row.mask.size()) continue;
    const std::int32_t node = row.head[row.first * 64 + std::countr_zero(row.mask[row.first])];
    leave(node);
    --count_[links_[node].f - base_];
    --size_;
    return node;
  }
}

Tick FocalQueue::least_f() {
  while (count_[least_ - base_] == 0) ++least_;
  return least_;
}

void FocalQueue::raise(Tick bound) {
  for (Tick f = bound_ + 1; f <= bound && f - base_ < static_cast<Tick>(far_.size()); ++f) {
    std::int32_t node = std::exchange(far_[f - base_], kNone);
    while (node != kNone) {
      const std::int32_t next = links_[node].next;
      bound_ = f;
      enter(node);
      node = next;
    }
  }
  bound_ = std::max(bound_, bound);
}

void FocalQueue::enter(std::int32_t node) {
  Link& link = links_[node];
  std::int32_t* head;
  if (link.f > bound_) {
    head = &far_[link.f - base_];
  } else {
    for (; used_rows_ <= link.row; ++used_rows_) rows_[used_rows_].first = 0;
    Row& row = rows_[link.row];
    const auto column = static_cast<std::size_t>(link.column), word = column / 64;
    if (column >= row.head.size()) {
      row.head.resize((word + 1) * 64, kNone);
      row.mask.resize(word + 1, 0);
    }
    row.mask[word] |= std::uint64_t{1} << (column % 64);
    row.first = std::min(row.first, word);
    first_row_ = std::min(first_row_, static_cast<int>(link.row));
    head = &row.head[column];
  }
  link.previous = kNone;
  link.next = *head;
  if (*head != kNone) links_[*head].previous = node;
  *head = node;
}

void FocalQueue::leave(std::int32_t node) {
  const Link& link = links_[node];
  if (link.next != kNone) links_[link.next].previous = link.previous;
  if (link.previous != kNone) {
    links_[link.previous].next = link.next;
  } else if (link.f > bound_) {
    far_[link.f - base_] = link.next;
  } else {
    Row& row = rows_[link.row];
    row.head[link.column] = link.next;
    if (link.next == kNone) row.mask[link.column / 64] &= ~(std::uint64_t{1} << (link.column % 64));
  }
}

}  // namespace mrpbench::mapf
