// Scores of trajectories by where objects that move will be when the robot comes there.
#include <algorithm>
#include <cmath>

#include "mrpbench_local/dwb/critics.hpp"

namespace mrpbench::local {

namespace {

class PredictedObstacle : public Critic {
 public:
  struct Options : ForecastOptions {
    static Description<Options> description() { return rows<Options>(); }
  };
  explicit PredictedObstacle(const Options& options) : options_(options) {}

  double weight(const Scene& scene) const override { return scene.forecast == nullptr ? 0 : 1; }

  /// The highest score of any pose with any object at its time.
  bool score(const Scene& scene, const Trajectories& all, std::span<double> raw, std::span<Reason>) override {
    const Forecast& forecast = *scene.forecast;
    double radius = 0, way = 0;
    for (const Point& it : scene.costmap->options().footprint) radius = std::max(radius, sim::length(it));
    for (std::size_t i = 0; i < all.size(); ++i) way = std::max(way, std::abs(all.twist(i).ahead) * all.duration());
    way = std::max(way, std::abs(scene.twist.ahead) * all.duration());
    const auto discs = within_reach(forecast, {scene.pose.x, scene.pose.y}, radius, way, options_.distance);
    const double horizon = forecast.duration();
    for (std::size_t i = 0; i < raw.size(); ++i) {
      raw[i] = 0;
      if (discs.empty()) continue;
      const double dt = all.duration() / all.steps(all.twist(i));
      const double last = std::min(all.duration(), horizon);
      Point before{scene.pose.x, scene.pose.y};
      double time = -dt;
      all.walk(i, [&](Pose pose) {
        const Point here{pose.x, pose.y};
        // Steps are short by way and angle, but may be long by time: on the way objects are met as well.
        const double from = std::max(0.0, time), until = std::min(std::max(0.0, time + dt), last);
        const int parts = std::max(1, static_cast<int>(std::ceil((until - from) / forecast.step - 1e-9)));
        for (int part = 1; part <= parts && from <= last; ++part) {
          const double share = static_cast<double>(part) / parts, at = from + (until - from) * share;
          const Point place = before + (here - before) * share;
          for (const std::size_t disc : discs) {
            const double touching = radius + forecast.radius[disc];
            const double gap = sim::length(forecast.at(disc, at) - place) - touching;
            if (gap >= options_.distance) continue;
            raw[i] = std::max(raw[i], forecast_score(gap, touching, options_) * options_.weight(at, horizon));
          }
        }
        before = here;
        time += dt;
        return time < last;
      });
    }
    return false;
  }

 private:
  Options options_;
};

}  // namespace

CriticKind predicted_obstacle() {
  return kind_of<PredictedObstacle>();
}

}  // namespace mrpbench::local
