#include "mrpbench_sim/disc_hash.hpp"

namespace mrpbench::sim {

void DiscHash::build(std::span<const Point> points) {
  found_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point p = points[i];
    if (!somewhere(p)) continue;
    found_.push_back({cell(p.x), cell(p.y), static_cast<int>(i)});
  }
  std::size_t slots = 1;
  while (slots < 2 * found_.size()) slots *= 2;
  mask_ = slots - 1;
  first_.assign(slots + 2, 0);
  // Counting sort: first_[s + 2] counts slot s, then first_[s + 1] is where its next entry goes.
  for (const Entry& entry : found_) ++first_[hash(entry.column, entry.row) + 2];
  for (std::size_t s = 2; s < first_.size(); ++s) first_[s] += first_[s - 1];
  entries_.resize(found_.size());
  for (const Entry& entry : found_) entries_[first_[hash(entry.column, entry.row) + 1]++] = entry;
}

}  // namespace mrpbench::sim
