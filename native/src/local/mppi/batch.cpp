#include "mrpbench_local/mppi/batch.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mrpbench_local/wide.hpp"

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

Pose Batch::in_map(float px, float py, float heading) const {
  const double cosine = std::cos(robot.yaw), sine = std::sin(robot.yaw);
  return {robot.x + cosine * px - sine * py, robot.y + sine * px + cosine * py, robot.yaw + heading};
}

MRPBENCH_WIDE void Batch::find_furthest() {
  const std::size_t count = samples(), last = steps() - 1;
  along_.assign(count, 0);
  for (std::size_t t = 0; t <= last; ++t) {
    const float* const v = vx[t];
    for (std::size_t k = 0; k < count; ++k) along_[k] += std::abs(v[k]) * dt;
  }
  nearest_.assign(count, std::numeric_limits<float>::max());
  index_.assign(count, 0);
  const float* const ex = x[last];
  const float* const ey = y[last];
  const float start = path.size() > 0 ? std::hypot(path.x[0], path.y[0]) : 0;
  for (std::size_t p = 0; p < path.size(); ++p) {
    const float px = path.x[p], py = path.y[p];
    const float reach = std::max(0.0f, static_cast<float>(p) * path.spacing - start - path.spacing);
    const auto number = static_cast<std::int32_t>(p);
    for (std::size_t k = 0; k < count; ++k) {
      const float dx = ex[k] - px, dy = ey[k] - py, squared = dx * dx + dy * dy;
      const bool nearer = (squared < nearest_[k]) & (reach <= along_[k]);
      nearest_[k] = nearer ? squared : nearest_[k];
      index_[k] = nearer ? number : index_[k];
    }
  }
  std::int32_t most = 0;
  for (std::size_t k = 0; k < count; ++k) most = std::max(most, index_[k]);
  furthest = static_cast<std::size_t>(most);
}

}  // namespace mrpbench::local::mppi
