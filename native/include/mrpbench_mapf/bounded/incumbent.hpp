// A solution that is looked for aside of a constraint tree, by large neighbourhood search (`lns/`): it will do as soon
// as it costs at most w times the lower bound that the tree has proved. Trees are good at lower bounds and local search
// at solutions; that a bound of one may be met by the other is the idea of incumbents in branch and bound.
#pragma once

#include <memory>
#include <vector>

#include "mrpbench_mapf/distance_table.hpp"
#include "mrpbench_mapf/result.hpp"

namespace mrpbench::mapf {

class Incumbent {
 public:
  Incumbent(const Instance& instance, DistanceTables& distances, Limits& limits, Statistics& statistics);
  ~Incumbent();

  /// Look on until this has taken `effort`, in expansions of searches for a single robot.
  void advance(std::int64_t effort);
  /// So far.
  std::int64_t effort() const { return effort_; }
  /// What the best solution costs; kForever if there is none yet.
  Cost cost() const { return cost_; }
  const std::vector<Path>& paths() const { return paths_; }

 private:
  class Search;

  void keep(std::vector<Path> paths);

  Statistics& statistics_;
  std::unique_ptr<Search> search_;  // nothing where local search is not possible
  std::int64_t effort_ = 0;         // so far
  Cost cost_ = kForever;
  std::vector<Path> paths_;
};

}  // namespace mrpbench::mapf
