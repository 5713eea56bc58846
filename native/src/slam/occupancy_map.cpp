#include "mrpbench_slam/occupancy_map.hpp"

namespace mrpbench::slam {

namespace {

int tile_of(int cell) {
  return (cell >= 0 ? cell : cell - Tile::kSide + 1) / Tile::kSide;
}

/// Metres by which the farthest end of a scan moves from one pose to another, at most.
double moved(const Scan& scan, Pose before, Pose after) {
  if (before.x == after.x && before.y == after.y && before.yaw == after.yaw) return 0;
  double reach = 0;
  for (const auto* ends : {&scan.hits, &scan.misses}) {
    for (const Point& it : *ends) reach = std::max(reach, sim::length(it));
  }
  return std::hypot(after.x - before.x, after.y - before.y) + reach * std::abs(wrapped(after.yaw - before.yaw));
}

}  // namespace

void OccupancyMap::insert(std::size_t index, const Scan& scan, Pose pose) {
  if (index < inserted_.size()) {
    if (moved(scan, inserted_[index], pose) <= resolution_ / 2) return;
    add(scan, inserted_[index], -1);
    inserted_[index] = pose;
  } else {
    inserted_.push_back(pose);
  }
  add(scan, pose, 1);
}

void OccupancyMap::add(const Scan& scan, Pose pose, std::int32_t by) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw), per_metre = 1 / resolution_;
  const auto in_cells = [&](Point point) { return placed(pose, c, s, point) * per_metre; };
  const Point from = in_cells(scan.origin);
  Box box{{floor_index(from.x), floor_index(from.y)}, {}};
  box.high = box.low;
  for (const auto* ends : {&scan.hits, &scan.misses}) {
    for (const Point& end : *ends) {
      const Point to = in_cells(end);
      box.low = {std::min(box.low.column, floor_index(to.x)), std::min(box.low.row, floor_index(to.y))};
      box.high = {std::max(box.high.column, floor_index(to.x)), std::max(box.high.row, floor_index(to.y))};
    }
  }
  counts_.cover({box.low, {box.high.column + 1, box.high.row + 1}});
  for (const auto* ends : {&scan.hits, &scan.misses}) {
    const bool ended = ends == &scan.hits;
    for (const Point& end : *ends) {
      const Point to = in_cells(end);
      traverse(from.x, from.y, to.x, to.y, [&](Cell it) { counts_.at(it).passed += by; });
      if (!ended) continue;
      Counts& last = counts_.at({floor_index(to.x), floor_index(to.y)});
      last.passed += by;
      last.ended += by;
    }
  }
  const Box tiles{{tile_of(box.low.column), tile_of(box.low.row)},
                  {tile_of(box.high.column) + 1, tile_of(box.high.row) + 1}};
  touched_.cover(tiles);
  for (int y = tiles.low.row; y < tiles.high.row; ++y) {
    for (int x = tiles.low.column; x < tiles.high.column; ++x) touched_.at({x, y}) = 1;
  }
}

std::int8_t OccupancyMap::value(Cell it) const {
  const Counts counts = counts_.value(it);
  if (counts.passed < least_) return -1;
  return counts.ended > share_ * counts.passed ? 100 : 0;
}

std::vector<Tile> OccupancyMap::changed() {
  std::vector<Tile> found;
  const Box tiles = touched_.box();
  shown_.cover(counts_.box());
  for (int y = tiles.low.row; y < tiles.high.row; ++y) {
    for (int x = tiles.low.column; x < tiles.high.column; ++x) {
      if (touched_.at({x, y}) == 0) continue;
      touched_.at({x, y}) = 0;
      Tile tile{{x, y}, {}};
      bool differs = false;
      for (int k = 0; k < Tile::kSide * Tile::kSide; ++k) {
        const Cell cell{x * Tile::kSide + k % Tile::kSide, y * Tile::kSide + k / Tile::kSide};
        const std::int8_t now = value(cell);
        tile.cells[static_cast<std::size_t>(k)] = now;
        if (!shown_.has(cell) || shown_.at(cell) == now + 1) continue;
        shown_.at(cell) = static_cast<std::int8_t>(now + 1);
        differs = true;
      }
      if (differs) found.push_back(tile);
    }
  }
  return found;
}

}  // namespace mrpbench::slam
