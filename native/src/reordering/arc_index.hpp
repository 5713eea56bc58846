// The arcs of all choices and the fixed ones, and those that leave and enter each event.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reordering/decisions.hpp"

namespace mrpbench::mapf {

class ArcIndex {
 public:
  ArcIndex(const AlternativeGraph& graph, const Decisions& decisions);

  const Arc& operator[](std::int32_t arc) const { return arcs_[arc]; }
  std::int32_t size() const { return static_cast<std::int32_t>(arcs_.size()); }
  /// Numbers of the arcs of a choice: [begin(choice), end(choice)).
  std::int32_t begin(Choice choice) const { return begin_[choice.index()]; }
  std::int32_t end(Choice choice) const { return begin_[choice.index() + 1]; }
  /// Those from here on are fixed.
  std::int32_t first_fixed() const { return begin_.back(); }
  /// The choice to which an arc belongs that is not fixed.
  Choice choice_of(std::int32_t arc) const {
    const std::int32_t decision = decision_of_[arc];
    return {decision, static_cast<Side>(arc >= end({decision, 0}))};
  }
  /// By arc: it is fixed, or belongs to the choice that `sides` gives its decision.
  std::vector<char> holding(std::span<const Side> sides) const;
  std::vector<char> fixed() const;

  std::span<const std::int32_t> out(std::int32_t event) const { return part(out_, out_begin_, event); }
  std::span<const std::int32_t> in(std::int32_t event) const { return part(in_, in_begin_, event); }

 private:
  static std::span<const std::int32_t> part(const std::vector<std::int32_t>& all,
                                            const std::vector<std::int32_t>& begin, std::int32_t event) {
    return {all.data() + begin[event], all.data() + begin[event + 1]};
  }

  std::vector<Arc> arcs_;
  std::vector<std::int32_t> begin_, decision_of_;
  std::vector<std::int32_t> out_, out_begin_, in_, in_begin_;
};

}  // namespace mrpbench::mapf
