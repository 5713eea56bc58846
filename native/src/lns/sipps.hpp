// Safe interval path planning with soft constraints: the path of one robot that has the fewest conflicts with those of
// others, the earliest among these; or the earliest without any.
// Li, Chen, Harabor, Stuckey and Koenig, "MAPF-LNS2: Fast repairing for multi-agent path finding via large neighborhood
// search", AAAI 2022.
#pragma once

#include "lns/traffic.hpp"
#include "mrpbench_mapf/common/lazy_rows.hpp"
#include "mrpbench_mapf/common/random.hpp"
#include "mrpbench_mapf/single_agent/distance_table.hpp"

namespace mrpbench::mapf::lns {

enum class Others { hard, soft };

class Sipps {
 public:
  Sipps(const Traffic& traffic, std::uint64_t seed, Limits& limits, Statistics& statistics);

  /// Find a path of `robot`, which must not be in the traffic, that arrives at `latest` or before; false if there is
  /// none.
  bool search(int robot, DistanceTable& distance, Others others, Tick latest, Path& path);

  /// Of all searches so far.
  std::int64_t expansions() const { return statistics_.low_level_expansions; }

 private:
  /// The other robots at a vertex at some time.
  struct Occupancy {
    std::int32_t present = 0;              // soft: visits
    std::int32_t begun = 0;                // soft: of these, those that were not there in the interval before
    std::int32_t before = -1, after = -1;  // hard: robots that are there just before and just after, -1 = none
  };
  /// An interval at a vertex in which the same others are there (hard: none).
  struct State {
    Tick first, last;
    std::int32_t vertex;
    Occupancy occupancy;
    Tick closed;             // earliest arrival of a label that was expanded
    Tick arrival;            // of the label generated last
    std::int32_t conflicts;  // of that label
  };
  struct Label {
    Tick arrival;
    std::int32_t conflicts;
    std::int32_t state;
    std::int32_t parent;  // label, -1 = none
    std::int32_t edge;    // by which it was reached, -1 = by waiting
    bool final;
  };
  struct Open {
    std::uint64_t key;     // conflicts, then arrival at the goal
    std::uint32_t second;  // then distance, then chance
    std::int32_t label;
    bool operator>(const Open& other) const { return key != other.key ? key > other.key : second > other.second; }
  };
  /// An edge that the robot may use, at hand for the vertex that it leaves.
  struct Way {
    std::int32_t edge, head;
    Tick duration;
  };
  struct Ways {
    std::vector<std::int32_t> first;  // by vertex, and the end
    std::vector<Way> way;
  };
  struct Window {
    Half first, last;
  };
  using Row = LazyRows<State>::Row;

  void gather_ways(int profile);
  void begin(int robot);
  Row states_of(int vertex);
  std::span<const Visit> visits_at(int vertex);
  Window window_of(int vertex);
  void add_free(int vertex, std::vector<State>& states);
  void add_shared(int vertex, std::vector<State>& states);
  static void add_state(std::vector<State>& states, int vertex, Half first, Half last, Occupancy occupancy);
  std::span<const Range> departures_of(int edge);
  Tick earliest_stay();
  void expand(int label);
  void follow(int label, int edge, int to);
  void reach(int parent, int to, int edge, Tick arrival, int conflicts);
  void finish(int label);
  void push(const Label& label, Tick h);
  void trace(int label, Path& path) const;
  bool is_soft() const { return others_ == Others::soft; }

  const Traffic& traffic_;
  const Instance& instance_;
  const Roadmap& roadmap_;
  Limits& limits_;
  Statistics& statistics_;
  Random random_;
  std::vector<Ways> ways_;  // by profile
  // the current search
  int robot_ = -1;
  Others others_ = Others::hard;
  Tick latest_ = 0;
  Tick least_ = 0;
  Tick alone_ = 0;  // when it would arrive without any others
  DistanceTable* distance_ = nullptr;
  std::span<const Tick> duration_;
  const Ways* out_ = nullptr;
  LazyRows<State> states_;      // by vertex
  LazyRows<Range> departures_;  // forbidden ones (soft: in conflict), by edge
  std::vector<Label> labels_;
  std::vector<Open> open_;
  std::vector<Visit> visits_;
  std::vector<Range> ranges_;
  std::vector<Half> ends_;
  std::size_t counted_ = 0;
};

}  // namespace mrpbench::mapf::lns
