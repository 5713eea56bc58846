#include "mrpbench_discrete/cluster_graph.hpp"

#include <algorithm>

namespace mrpbench::discrete {
namespace {

constexpr int kStretch = 16;
///< Pairs of cells of a border that share an entrance, at most.

}  // namespace

ClusterGraph::ClusterGraph(const Grid& grid) : grid_(grid) {
  divide();
  find_entrances();
  join_entrances();
}

void ClusterGraph::divide() {
  const int columns = (grid_.width() + side - 1) / side, rows = (grid_.height() + side - 1) / side;
  cells_.resize(static_cast<std::size_t>(rows) * columns);
  doors_.resize(cells_.size());
  for (int cell = 0; cell < grid_.size(); ++cell) {
    const int place = grid_.place(cell);
    const int cluster = place / grid_.width() / side * columns + place % grid_.width() / side;
    cluster_.push_back(cluster);
    index_.push_back(static_cast<std::uint16_t>(cells_[cluster].size()));
    cells_[cluster].push_back(cell);
  }
}

void ClusterGraph::find_entrances() {
  for (const int heading : {0, 1}) {
    const int border = heading == 0 ? grid_.width() : grid_.height(), along = heading == 0 ? 1 : 0;
    const int length = heading == 0 ? grid_.height() : grid_.width();
    for (int line = side - 1; line + 1 < border; line += side) {
      std::vector<std::array<std::int32_t, 2>> stretch;
      const auto close = [&] {
        if (stretch.empty()) return;
        const auto id = static_cast<std::int32_t>(entrances_.size());
        entrances_.push_back({stretch[stretch.size() / 2], heading});
        for (const int own : {0, 1}) doors_[cluster_[entrances_.back().cell[own]]].push_back({id, own});
        stretch.clear();
      };
      for (int k = 0; k < length; ++k) {
        if (k % side == 0 || stretch.size() == kStretch) close();
        const std::int64_t row = along ? k : line, column = along ? line : k;
        const int cell = grid_.free_cell(row * grid_.width() + column);
        const int ahead = cell < 0 ? -1 : grid_.ahead(cell, heading);
        if (ahead < 0)
          close();
        else
          stretch.push_back({cell, ahead});
      }
      close();
    }
  }
}

void ClusterGraph::join_entrances() {
  std::vector<std::vector<Edge>> edges(entrances_.size());
  std::vector<std::uint32_t> cost;
  std::vector<Seed> seeds;
  for (std::size_t cluster = 0; cluster < doors_.size(); ++cluster) {
    for (const Door& from : doors_[cluster]) {
      seeds = {{0, index_[entrances_[from.entrance].cell[from.own]]}};
      spread(static_cast<int>(cluster), seeds, cost);
      for (const Door& to : doors_[cluster]) {
        const std::uint32_t moves = cost[index_[entrances_[to.entrance].cell[to.own]]];
        if (to.entrance == from.entrance || moves == unreachable) continue;
        edges[from.entrance].push_back({to.entrance, moves + 1});
        longest_ = std::max(longest_, moves + 1);
      }
    }
  }
  first_edge_.push_back(0);
  for (const auto& own : edges) {
    edges_.insert(edges_.end(), own.begin(), own.end());
    first_edge_.push_back(static_cast<std::int32_t>(edges_.size()));
  }
}

void ClusterGraph::spread(int cluster, std::vector<Seed>& seeds, std::vector<std::uint32_t>& cost) const {
  cost.assign(cells_[cluster].size(), unreachable);
  std::sort(seeds.begin(), seeds.end());
  std::vector<std::int32_t> queue;
  queue.reserve(cost.size());
  std::size_t next = 0;
  // Seeds and queue are both in order of cost.
  for (std::size_t done = 0; done < queue.size() || next < seeds.size();) {
    const bool seed = done == queue.size() || (next < seeds.size() && seeds[next].first < cost[queue[done]]);
    if (seed) {
      const auto [own, index] = seeds[next++];
      if (own >= cost[index]) continue;
      cost[index] = own;
      queue.insert(queue.begin() + static_cast<std::ptrdiff_t>(done), index);
    }
    const int index = queue[done++], cell = cells_[cluster][index];
    for (int heading = 0; heading < 4; ++heading) {
      const int near = grid_.ahead(cell, heading);
      if (near < 0 || cluster_[near] != cluster || cost[index] + 1 >= cost[index_[near]]) continue;
      cost[index_[near]] = cost[index] + 1;
      queue.push_back(index_[near]);
    }
  }
}

/// Dial's algorithm (1969).
std::vector<std::uint32_t> ClusterGraph::costs(int goal) const {
  std::vector<std::uint32_t> found(entrances_.size(), unreachable), inside;
  std::vector<std::vector<std::int32_t>> buckets(std::max<std::uint32_t>(longest_, side * side) + 1);
  std::size_t waiting = 0;
  const auto reach = [&](std::int32_t entrance, std::uint32_t cost) {
    if (cost >= found[entrance]) return;
    found[entrance] = cost;
    buckets[cost % buckets.size()].push_back(entrance);
    ++waiting;
  };
  std::vector<Seed> seeds{{0, index_[goal]}};
  spread(cluster_[goal], seeds, inside);
  for (const Door& door : doors_[cluster_[goal]]) {
    const std::uint32_t moves = inside[index_[entrances_[door.entrance].cell[door.own]]];
    if (moves < unreachable) reach(door.entrance, moves);
  }
  for (std::uint32_t now = 0; waiting > 0; ++now) {
    auto& bucket = buckets[now % buckets.size()];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const std::int32_t entrance = bucket[i];
      if (found[entrance] != now) continue;
      for (std::int32_t k = first_edge_[entrance]; k < first_edge_[entrance + 1]; ++k) {
        reach(edges_[k].to, now + edges_[k].cost);
      }
    }
    waiting -= bucket.size();
    bucket.clear();
  }
  return found;
}

std::vector<std::uint32_t> ClusterGraph::words(int cluster, int goal, const std::vector<std::uint32_t>& costs,
                                               std::uint32_t turn) const {
  std::vector<Seed> seeds;
  if (cluster_[goal] == cluster) seeds.push_back({0, index_[goal]});
  for (const Door& door : doors_[cluster]) {
    if (costs[door.entrance] == unreachable) continue;
    seeds.push_back({costs[door.entrance] + 1, index_[entrances_[door.entrance].cell[door.own]]});
  }
  std::vector<std::uint32_t> cost;
  spread(cluster, seeds, cost);
  // By cell, the headings in which the next move of a shortest way leads.
  std::vector<std::uint8_t> next(cost.size(), 0);
  for (std::size_t i = 0; i < cost.size(); ++i) {
    for (int heading = 0; heading < 4; ++heading) {
      const int near = grid_.ahead(cells_[cluster][i], heading);
      if (near >= 0 && cluster_[near] == cluster && cost[index_[near]] < cost[i]) next[i] |= 1 << heading;
    }
  }
  for (const Door& door : doors_[cluster]) {
    const Entrance& it = entrances_[door.entrance];
    const int index = index_[it.cell[door.own]];
    if (cost[index] == costs[door.entrance] + 1) next[index] |= 1 << ((it.heading + 2 * door.own) & 3);
  }
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < cost.size(); ++i) {
    std::uint32_t word = cost[i] << 12;
    for (int heading = 0; heading < 4 && next[i]; ++heading) {
      const bool beside = next[i] & (1 << ((heading + 1) & 3) | 1 << ((heading + 3) & 3));
      const std::uint32_t turns = next[i] & 1 << heading ? 0 : beside ? 1 : 2;
      word |= turns * turn << (3 * heading);
    }
    found.push_back(word);
  }
  return found;
}

}  // namespace mrpbench::discrete
