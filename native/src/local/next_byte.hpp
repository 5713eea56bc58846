// Finds marks among many cells or samples.
#pragma once

#include <cstddef>
#include <cstring>

namespace mrpbench::local {

/// The index of the first of `count` bytes from `i` on that has this value, or their number.
inline std::size_t next_byte(const void* bytes, int value, std::size_t i, std::size_t count) {
  const char* const all = static_cast<const char*>(bytes);
  const void* const found = std::memchr(all + i, value, count - i);
  return found ? static_cast<std::size_t>(static_cast<const char*>(found) - all) : count;
}

}  // namespace mrpbench::local
