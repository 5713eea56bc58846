// The obstacle layer: marks where beams end, cleared where beams pass.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mrpbench_local/costmap/costmap.hpp"
#include "mrpbench_local/costmap/footprint.hpp"
#include "mrpbench_local/costmap/update_buffers.hpp"

namespace mrpbench::local {

namespace {

/// Cells by which the centre of a cell of a line may be off the beam that the line stands for: the centres of the cells
/// in which the beam begins and ends are off by half a diagonal at most, cells of the line from that between them by
/// half a side.
constexpr double kOff = 1.25;

}  // namespace

/// Mark the cells in which the beams end, and clear the other cells along them.
void Costmap::trace() {
  if (!scan_.fresh) return;
  scan_.fresh = false;
  const Pose& pose = scan_.pose;
  const double cosine = std::cos(pose.yaw), sine = std::sin(pose.yaw);
  const Point mount = scan_.sensor.mount;
  const Point origin{pose.x + cosine * mount.x - sine * mount.y, pose.y + sine * mount.x + cosine * mount.y};
  const Cell start = frame_.cell(origin);
  if (!frame_.holds(start)) return;
  UpdateBuffers& its = UpdateBuffers::of_thread();
  its.beams.aim(scan_.ranges.size(), origin, pose.yaw);
  its.lengths.resize(scan_.ranges.size());
  its.ends.resize(scan_.ranges.size());
  its.hit.begin(frame_);
  if (options_.marking) mark_hits();
  if (options_.clearing) clear_beams(start);
}

void Costmap::mark_hits() {
  UpdateBuffers& its = UpdateBuffers::of_thread();
  its.nearest.resize(frame_.size());
  for (std::size_t i = 0; i < its.lengths.size(); ++i) {
    const double range = scan_.ranges[i];
    its.lengths[i] = range >= options_.obstacle_min_range && range < options_.obstacle_max_range ? range : -1;
  }
  its.beams.end_cells(frame_, its.lengths, its.ends);
  // Of the beams that end in a cell the shortest, of equal ones the first.
  for (std::size_t i = 0; i < its.ends.size(); ++i) {
    const Cell c = its.ends[i];
    if (its.lengths[i] < 0 || !frame_.holds(c)) continue;
    __builtin_prefetch(&hits_[hit_of(c)], 1);
    UpdateBuffers::Nearest& nearest = its.nearest[frame_.index(c)];
    const bool nearer = its.lengths[i] < nearest.range;
    nearest.range = nearer ? static_cast<float>(its.lengths[i]) : nearest.range;
    nearest.beam = nearer ? static_cast<std::int32_t>(i) : nearest.beam;
    its.hit.insert(c);
  }
  its.hit.each([&](Cell c) {
    const auto beam = static_cast<std::size_t>(std::exchange(its.nearest[frame_.index(c)], {}).beam);
    const Point away = its.beams.end(beam, its.lengths[beam]) - frame_.centre(c);
    const Point inside = away * (1 / frame_.resolution) + Point{0.5, 0.5};
    hits_[hit_of(c)] = {static_cast<float>(inside.x), static_cast<float>(inside.y)};
  });
  marks_.insert(its.hit);
}

/// Clear the marks that are not of this scan and through whose cells a beam passes. They are few, because most of what
/// a scan sees the one before saw too, so each is compared with the beams near it instead of walking along all beams.
void Costmap::clear_beams(Cell start) {
  UpdateBuffers& its = UpdateBuffers::of_thread();
  its.old.clear();
  marks_.each_not_in(its.hit, [&](Cell c) { its.old.push_back(c); });
  if (its.old.empty()) return;
  const double unseen = options_.inf_is_valid ? scan_.sensor.range : -1;
  for (std::size_t i = 0; i < its.lengths.size(); ++i) {
    const double range = std::isfinite(scan_.ranges[i]) ? scan_.ranges[i] : unseen;
    its.lengths[i] = std::min(range, options_.raytrace_max_range);
  }
  its.beams.clip(frame_, its.lengths);
  its.beams.end_cells(frame_, its.lengths, its.ends);
  const double hidden = options_.raytrace_min_range / frame_.resolution;
  const auto passes = [&](std::size_t beam, Cell away) {
    if (its.lengths[beam] < 0) return false;
    const Cell end = its.ends[beam];
    return Line(start, {std::clamp(end.x, 0, frame_.width - 1), std::clamp(end.y, 0, frame_.height - 1)}).holds(away);
  };
  for (const Cell c : its.old) {
    const Cell away{c.x - start.x, c.y - start.y};
    if (hidden > 0 && away.x * away.x + away.y * away.y < hidden * hidden) continue;
    const auto [first, count] = its.beams.around(frame_.centre(c), kOff * frame_.resolution);
    std::size_t beam = first;
    for (std::size_t k = 0; k < count; ++k, beam = beam + 1 == its.ends.size() ? 0 : beam + 1) {
      if (!passes(beam, away)) continue;
      marks_.erase(c);
      break;
    }
  }
}

void Costmap::clear_footprint(Pose pose) {
  place(options_.footprint, pose, corners_);
  Point low = corners_[0], high = corners_[0];
  for (const Point& p : corners_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Cell from = frame_.cell(low), to = frame_.cell(high);
  for (int y = std::max(from.y, 0); y <= std::min(to.y, frame_.height - 1); ++y) {
    for (int x = std::max(from.x, 0); x <= std::min(to.x, frame_.width - 1); ++x) {
      if (marks_.holds({x, y}) && inside(corners_, frame_.centre({x, y}))) marks_.erase({x, y});
    }
  }
}

}  // namespace mrpbench::local
