// Distances by vertex, flat or in pages that are made when a search first comes there and hold a byte per vertex: a
// table of each of 10,000 goals then fits into memory.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "mrpbench_mapf/common/limits.hpp"
#include "mrpbench_mapf/model/time.hpp"

namespace mrpbench::mapf {

class Distances {
 public:
  /// All are kForever; in `pages`, distances that are multiples of `unit` take least.
  Distances(int vertices, bool pages, Tick unit, Limits& limits);

  bool in_pages() const { return !pages_.empty(); }
  Tick operator[](int vertex) const { return pages_.empty() ? flat_[vertex] : paged(vertex); }
  void set(int vertex, Tick distance, Limits& limits) {
    if (pages_.empty()) {
      flat_[vertex] = distance;
    } else {
      set_paged(vertex, distance, limits);
    }
  }
  /// Count what is in memory towards the limits of another call.
  void charge(Limits& limits) const { limits.charge(bytes_); }

 private:
  static constexpr std::size_t kHeader = 16;  // bytes that an allocation takes beside its content
  static constexpr int kPage = 128;           // vertices with near numbers lie near one another
  static constexpr std::uint8_t kUnknown = 255;

  struct Page {
    Tick base;                                // the first distance
    std::array<std::uint8_t, kPage> beyond;   // units beyond it
    std::unique_ptr<std::vector<Tick>> wide;  // all distances, where a byte does not hold one of them
  };

  Tick paged(int vertex) const;
  void set_paged(int vertex, Tick distance, Limits& limits);
  void widen(Page& page, Limits& limits);

  std::vector<Tick> flat_;
  std::vector<std::unique_ptr<Page>> pages_;
  Tick unit_;
  std::size_t bytes_;
};

}  // namespace mrpbench::mapf
