// Large neighbourhood search (`lns/`) in addition to a constraint tree: its solution is returned as soon as it costs at
// most w times the lower bound that the tree has proved. Trees raise lower bounds quickly, and local search finds
// solutions quickly. The solution is an incumbent in the sense of branch and bound.
#pragma once

#include <memory>
#include <vector>

#include "mrpbench_mapf/cbs/low_level/search_context.hpp"

namespace mrpbench::mapf {

class AnytimeFallback {
 public:
  /// `result` counts the low-level expansions of all searches, and has the lower bound.
  AnytimeFallback(SearchContext& context, Result& result);
  ~AnytimeFallback();

  /// Call this before each expansion of the tree. After `incumbent_after` low-level expansions it searches half as long
  /// as the tree. True if there is a solution within the bound, which `result` then contains.
  bool solve();

 private:
  class Search;

  void begin();
  void advance(std::int64_t effort);
  void keep(std::vector<Path> paths);

  SearchContext& context_;
  Result& result_;
  std::optional<std::int64_t> root_effort_;  // low-level expansions for the root of the tree
  bool begun_ = false;
  std::unique_ptr<Search> search_;
  std::int64_t effort_ = 0;  // so far
  Cost cost_ = kForever;     // of `paths_`
  std::vector<Path> paths_;  // the best solution so far
};

}  // namespace mrpbench::mapf
