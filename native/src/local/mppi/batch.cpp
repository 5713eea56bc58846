#include "mrpbench_local/mppi/batch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local::mppi {

namespace {

thread_local Motions motions_of_thread;
thread_local std::vector<Ways> ways_of_thread;

Ways& ways_of(std::size_t block) {
  ways_of_thread.resize(std::max(ways_of_thread.size(), block + 1));
  return ways_of_thread[block];
}

}  // namespace

Lent::Lent(Batch& to, std::size_t block, std::size_t steps, std::size_t samples) : to_(to), ways_(ways_of(block)) {
  std::swap(static_cast<Motions&>(to_), motions_of_thread);
  std::swap(static_cast<Ways&>(to_), ways_);
  to_.resize(steps, samples);
  to_.first = block * kBlock;
}

Lent::~Lent() {
  std::swap(static_cast<Motions&>(to_), motions_of_thread);
  std::swap(static_cast<Ways&>(to_), ways_);
}

void Batch::place(Pose pose) {
  robot = pose;
  heading = {std::cos(pose.yaw), std::sin(pose.yaw)};
}

MRPBENCH_WIDE std::size_t Batch::find_furthest() {
  const std::size_t count = samples(), last = steps() - 1;
  nearest_.assign(count, std::numeric_limits<float>::max());
  index_.assign(count, 0);
  const float *const ex = x[last], *const ey = y[last], *const reached = length.data();
  float* const nearest = nearest_.data();
  std::int32_t* const index = index_.data();
  const float longest = *std::max_element(length.begin(), length.end());
  const float start = path.size() > 0 ? std::hypot(path.x[0], path.y[0]) : 0;
  for (std::size_t p = 0; p < path.size(); ++p) {
    const float px = path.x[p], py = path.y[p];
    const float reach = std::max(0.0f, static_cast<float>(p) * path.spacing - start - path.spacing);
    if (reach > longest) break;  // no sample comes there
    const auto number = static_cast<std::int32_t>(p);
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < count; ++k) {
      const float dx = ex[k] - px, dy = ey[k] - py, squared = dx * dx + dy * dy;
      const bool nearer = (squared < nearest[k]) & (reach <= reached[k]);
      nearest[k] = nearer ? squared : nearest[k];
      index[k] = nearer ? number : index[k];
    }
  }
  std::int32_t most = 0;
  for (std::size_t k = 0; k < count; ++k) most = std::max(most, index_[k]);
  return static_cast<std::size_t>(most);
}

}  // namespace mrpbench::local::mppi
