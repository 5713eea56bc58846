// A key of a set of constraints: order does not matter, and adding one is cheap.
#pragma once

#include <cstdint>

#include "mrpbench_mapf/cbs/constraints/constraint.hpp"

namespace mrpbench::mapf {

/// 128 bits: two different sets among the few millions of a search have the same key with probability 1e-25.
struct Key {
  std::uint64_t low = 0, high = 0;

  bool operator==(const Key&) const = default;
  Key& operator+=(const Key& other) {
    low += other.low;
    high += other.high;
    return *this;
  }
};

struct KeyHash {
  std::size_t operator()(const Key& key) const { return key.low; }
};

/// The finaliser of Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
inline std::uint64_t mix(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ x >> 27) * 0x94D049BB133111EBULL;
  return x ^ x >> 31;
}

inline Key key_of_goal(int vertex) {
  const auto where = static_cast<std::uint64_t>(vertex) + 1;
  return {mix(where * 0xA24BAED4963EE407ULL), mix(where * 0x9FB21C651E98DF25ULL)};
}

inline Key key_of(const Constraint& constraint) {
  const auto word = [](std::int32_t high, std::int32_t low) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(high)) << 32 | static_cast<std::uint32_t>(low);
  };
  const std::uint64_t where = mix(word(constraint.robot * 8 + static_cast<int>(constraint.kind), constraint.element));
  const std::uint64_t when = word(constraint.range.first, constraint.range.last);
  return {mix(where + 0x9E3779B97F4A7C15ULL * (when + 1)), mix((where ^ 0xD1B54A32D192ED03ULL) + mix(when))};
}

}  // namespace mrpbench::mapf
