// Scores of samples by where objects that move will be when the robot comes there.
#include <algorithm>
#include <cmath>

#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/mppi/critic.hpp"

namespace mrpbench::local::mppi {

namespace {

/// A disc at one time, in the frame of the robot.
struct Nearby {
  float x, y, touching;
};

MRPBENCH_WIDE void add_highest(std::size_t count, const float* x, const float* y, Nearby disc, float distance,
                               float near_score, float weight, float* raw) {
  const float per_touching = 1 / disc.touching, per_distance = 1 / distance;
  MRPBENCH_NO_OVERLAP
  for (std::size_t k = 0; k < count; ++k) {
    const float dx = x[k] - disc.x, dy = y[k] - disc.y;
    const float gap = std::sqrt(dx * dx + dy * dy) - disc.touching;
    const float share = std::max(1 - gap * per_distance, 0.0f);
    const float score = gap < 0 ? 1 - gap * per_touching : near_score * share * share;
    raw[k] = std::max(raw[k], score * weight);
  }
}

class PredictedObstacle : public Critic {
 public:
  struct Options : Weighting, ForecastOptions {
    static Description<Options> description() { return rows<Options>(); }
  };
  explicit PredictedObstacle(const Options& options) : options_(options) {}

  /// The highest score of any pose with any object at its time.
  bool score(const Batch& batch, std::span<float> raw) override {
    if (batch.forecast == nullptr) return true;
    const Forecast& forecast = *batch.forecast;
    double radius = 0;
    for (const Point& it : batch.costmap->options().footprint) radius = std::max(radius, sim::length(it));
    const double horizon = forecast.duration(), dt = batch.dt;
    const double way = *std::max_element(batch.length.begin(), batch.length.end());
    const Point robot{batch.robot.x, batch.robot.y}, ahead = batch.heading;
    const auto discs = within_reach(forecast, robot, radius, way, options_.distance);
    for (std::size_t t = 0; t < batch.steps() && !discs.empty(); ++t) {
      const double time = dt * static_cast<double>(t + 1);  // the first pose is one step ahead
      if (time > horizon) break;
      for (const std::size_t disc : discs) {
        const Point off = forecast.at(disc, time) - robot;
        const Nearby it{static_cast<float>(ahead.x * off.x + ahead.y * off.y),
                        static_cast<float>(ahead.x * off.y - ahead.y * off.x),
                        static_cast<float>(radius + forecast.radius[disc])};
        add_highest(raw.size(), batch.x[t], batch.y[t], it, static_cast<float>(options_.distance),
                    static_cast<float>(options_.near_score), static_cast<float>(options_.weight(time, horizon)),
                    raw.data());
      }
    }
    return true;
  }

 private:
  Options options_;
};

}  // namespace

CriticKind predicted_obstacle_critic() {
  return kind_of<PredictedObstacle>(20);
}

}  // namespace mrpbench::local::mppi
