#include "mrpbench_local/mppi/batch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local::mppi {

namespace {

thread_local Tables of_thread;

}  // namespace

Lent::Lent(Tables& to, std::size_t steps, std::size_t samples) : to_(to) {
  std::swap(to_, of_thread);
  to_.resize(steps, samples);
}

Lent::~Lent() {
  std::swap(to_, of_thread);
}

void Batch::place(Pose pose) {
  robot = pose;
  heading = {std::cos(pose.yaw), std::sin(pose.yaw)};
}

MRPBENCH_WIDE void Batch::find_furthest() {
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
  furthest = static_cast<std::size_t>(most);
}

}  // namespace mrpbench::local::mppi
