// Random numbers as functions of their keys: SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
#pragma once

#include <cstdint>

namespace mrpbench::discrete {

inline std::uint64_t mixed(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15ull;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
  return value ^ (value >> 31);
}

template <class... Keys>
std::uint64_t drawn(std::uint64_t seed, Keys... keys) {
  std::uint64_t value = mixed(seed);
  ((value = mixed(value ^ static_cast<std::uint64_t>(keys))), ...);
  return value;
}

/// In [0, 1).
template <class... Keys>
double drawn_unit(std::uint64_t seed, Keys... keys) {
  return static_cast<double>(drawn(seed, keys...) >> 11) * 0x1p-53;
}

}  // namespace mrpbench::discrete
