// Decision diagrams by robot, constraints and cost, shared by all nodes in which a robot has the same constraints.
#pragma once

#include <memory>
#include <unordered_map>

#include "mrpbench_mapf/cbs/constraints/key.hpp"
#include "mrpbench_mapf/cbs/low_level/mdd.hpp"

namespace mrpbench::mapf {

class MddCache {
 public:
  /// When the diagrams exceed `bytes` in total, all are removed.
  MddCache(Limits& limits, std::size_t bytes) : limits_(limits), room_(bytes) {}

  /// The diagram named by `robot`, `key` and `cost`, made by `make()` if it is new. Valid until it is removed.
  template <class Make>
  std::shared_ptr<const Mdd> get(int robot, Key key, Tick cost, Make make) {
    const Name name{robot, cost, key};
    const auto place = known_.find(name);
    if (place != known_.end()) return place->second;
    auto mdd = std::make_shared<const Mdd>(make());
    const std::size_t bytes = mdd->bytes() + sizeof(Name) + 64;
    if (used_ + bytes > room_) {
      known_.clear();
      used_ = 0;
    }
    used_ += bytes;
    limits_.charge_growth(counted_, used_);
    known_.emplace(name, mdd);
    return mdd;
  }

 private:
  struct Name {
    int robot;
    Tick cost;
    Key key;
    bool operator==(const Name&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Name& it) const {
      return mix(it.key.low + static_cast<std::uint64_t>(it.robot) * 0x9E3779B97F4A7C15ULL + it.cost);
    }
  };
  Limits& limits_;
  std::size_t room_;
  std::size_t used_ = 0, counted_ = 0;
  std::unordered_map<Name, std::shared_ptr<const Mdd>, Hash> known_;
};

}  // namespace mrpbench::mapf
