// Preferences for commands that do not depend on the path.
#include <cmath>

#include "mrpbench_local/critics.hpp"

namespace mrpbench::local {

namespace {

class PreferForward : public Critic {
 public:
  explicit PreferForward(CriticOptions& options)
      : penalty_(options.take("penalty", 1)),
        strafe_x_(options.take("strafe_x", 0.1)),
        strafe_theta_(options.take("strafe_theta", 0.2)),
        theta_scale_(options.take("theta_scale", 10)) {}

  void score(const Scene&, const Trajectories& all, std::span<double> raw, std::span<Reason>) override {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Twist twist = all.twist(i);
      const double rate = std::abs(twist.turn);
      const bool creeps = twist.ahead < 0 || (twist.ahead < strafe_x_ && rate < strafe_theta_);
      raw[i] = creeps ? penalty_ : rate * theta_scale_;
    }
  }

 private:
  double penalty_, strafe_x_, strafe_theta_, theta_scale_;
};

class Twirling : public Critic {
 public:
  void score(const Scene&, const Trajectories& all, std::span<double> raw, std::span<Reason>) override {
    for (std::size_t i = 0; i < all.size(); ++i) raw[i] = std::abs(all.twist(i).turn);
  }
};

}  // namespace

std::unique_ptr<Critic> prefer_forward(CriticOptions& options) {
  return std::make_unique<PreferForward>(options);
}

std::unique_ptr<Critic> twirling(CriticOptions&) {
  return std::make_unique<Twirling>();
}

}  // namespace mrpbench::local
