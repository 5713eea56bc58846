#include "mrpbench_mapf/model/roadmap.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mrpbench::mapf {

Roadmap::Roadmap(int vertex_count, std::vector<int> tail, std::vector<int> head, std::vector<Tick> duration,
                 std::vector<Point> position)
    : vertex_count_(vertex_count),
      profile_count_(tail.empty() ? 1 : static_cast<int>(duration.size() / tail.size())),
      tail_(std::move(tail)),
      head_(std::move(head)),
      duration_(std::move(duration)),
      position_(std::move(position)) {
  validate();
  index(tail_, out_first_, out_edge_);
  index(head_, in_first_, in_edge_);
}

std::vector<int> Roadmap::neighbours(int vertex) const {
  std::vector<int> found;
  for (const int edge : out(vertex)) found.push_back(head_[edge]);
  for (const int edge : in(vertex)) found.push_back(tail_[edge]);
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

std::size_t Roadmap::bytes() const {
  const std::size_t integers = tail_.capacity() + head_.capacity() + duration_.capacity() + out_first_.capacity() +
                               out_edge_.capacity() + in_first_.capacity() + in_edge_.capacity();
  return integers * sizeof(std::int32_t) + position_.capacity() * sizeof(Point);
}

void Roadmap::validate() const {
  if (head_.size() != tail_.size()) throw std::invalid_argument("edges need a vertex at both ends");
  if (duration_.size() != tail_.size() * static_cast<std::size_t>(profile_count_)) {
    throw std::invalid_argument("durations need one value per profile and edge");
  }
  if (!position_.empty() && position_.size() != static_cast<std::size_t>(vertex_count_)) {
    throw std::invalid_argument("positions need one point per vertex");
  }
  for (int edge = 0; edge < edge_count(); ++edge) {
    if (tail_[edge] < 0 || tail_[edge] >= vertex_count_ || head_[edge] < 0 || head_[edge] >= vertex_count_) {
      throw std::invalid_argument("edge " + std::to_string(edge) + " leads from or to a vertex that does not exist");
    }
  }
  for (std::size_t i = 0; i < duration_.size(); ++i) {
    if (duration_[i] < -1 || duration_[i] == 0 || duration_[i] > kLongestEdge) {
      throw std::invalid_argument("edge " + std::to_string(i % tail_.size()) + " takes " +
                                  std::to_string(duration_[i]) + " ticks; allowed are 1 to 2^20, or -1 = forbidden");
    }
  }
}

void Roadmap::index(const std::vector<int>& end, std::vector<int>& first, std::vector<int>& edge) const {
  first.assign(static_cast<std::size_t>(vertex_count_) + 1, 0);
  for (int e = 0; e < edge_count(); ++e) {
    if (tail_[e] != head_[e]) ++first[end[e] + 1];
  }
  for (int v = 0; v < vertex_count_; ++v) first[v + 1] += first[v];
  edge.resize(first.back());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (int e = 0; e < edge_count(); ++e) {
    if (tail_[e] != head_[e]) edge[next[end[e]]++] = e;
  }
}

}  // namespace mrpbench::mapf
