// Distances on large maps by clusters of cells and the entrances between them.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mrpbench_discrete/grid.hpp"

namespace mrpbench::discrete {

/// The abstract graph of HPA* (Botea, Müller and Schaeffer, "Near Optimal Hierarchical Path-Finding", Journal of Game
/// Development 1(1), 2004). The map is divided into square clusters. Each border between two clusters has entrances:
/// pairs of adjacent free cells, one in the middle of every stretch of such pairs. Edges join entrances of a cluster
/// and cost the moves between them inside the cluster; turns are not counted.
///
/// The cost from a cell to a goal is the least number of moves on a way that enters clusters by entrances alone: at
/// least the true distance. Each cell but the goal from which the goal is reachable has a neighbour of lower cost.
class ClusterGraph {
 public:
  static constexpr int side = 32;
  ///< Of a cluster, in cells.
  static constexpr std::uint32_t unreachable = (1u << 20) - 1;

  /// A cell of a cluster, by its number there, and a cost.
  using Seed = std::pair<std::uint32_t, std::int32_t>;

  explicit ClusterGraph(const Grid& grid);

  int cluster(int cell) const { return cluster_[cell]; }
  /// The number of a cell among the cells of its cluster.
  int index(int cell) const { return index_[cell]; }
  std::size_t entrances() const { return entrances_.size(); }
  /// The cost from each entrance, from its cell that is nearer to the goal.
  std::vector<std::uint32_t> costs(int goal) const;
  /// The words of `DistanceTable` for the cells of a cluster, given the costs from entrances.
  std::vector<std::uint32_t> words(int cluster, int goal, const std::vector<std::uint32_t>& costs,
                                   std::uint32_t turn) const;

 private:
  struct Entrance {
    std::array<std::int32_t, 2> cell;
    std::int32_t heading;  ///< from the first cell to the second one
  };
  struct Edge {
    std::int32_t to;
    std::uint32_t cost;
  };
  /// An entrance of a cluster, and which of its two cells is there.
  struct Door {
    std::int32_t entrance, own;
  };

  void divide();
  void find_entrances();
  void join_entrances();
  /// Breadth-first search inside a cluster; `cost` by numbers of cells.
  void spread(int cluster, std::vector<Seed>& seeds, std::vector<std::uint32_t>& cost) const;

  const Grid& grid_;
  std::vector<std::int32_t> cluster_;
  std::vector<std::uint16_t> index_;
  std::vector<std::vector<std::int32_t>> cells_;
  std::vector<std::vector<Door>> doors_;
  std::vector<Entrance> entrances_;
  std::vector<std::int32_t> first_edge_;
  std::vector<Edge> edges_;
  std::uint32_t longest_ = 1;
};

/// The costs to one goal: of entrances, and of the cells of the clusters that were asked for last.
class ClusterTable {
 public:
  ClusterTable(const ClusterGraph& graph, int goal, std::uint32_t turn)
      : graph_(&graph), goal_(goal), turn_(turn), costs_(graph.costs(goal)) {}

  std::uint32_t word(int cell) const {
    const int cluster = graph_->cluster(cell);
    for (const Tile& tile : tiles_) {
      if (tile.cluster == cluster) return tile.words[graph_->index(cell)];
    }
    return added(cluster).words[graph_->index(cell)];
  }
  /// Bytes of a table, at most.
  static std::size_t bytes(const ClusterGraph& graph) {
    return sizeof(std::uint32_t) * (graph.entrances() + kTiles * ClusterGraph::side * ClusterGraph::side);
  }

 private:
  struct Tile {
    int cluster = -1;
    std::vector<std::uint32_t> words;
  };
  static constexpr std::size_t kTiles = 4;
  ///< Clusters that meet in a corner.

  const Tile& added(int cluster) const {
    Tile& tile = tiles_[next_++ % kTiles];
    tile = {cluster, graph_->words(cluster, goal_, costs_, turn_)};
    return tile;
  }

  const ClusterGraph* graph_;
  int goal_;
  std::uint32_t turn_;
  std::vector<std::uint32_t> costs_;
  mutable std::array<Tile, kTiles> tiles_;
  mutable std::size_t next_ = 0;
};

}  // namespace mrpbench::discrete
