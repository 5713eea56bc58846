// Preferences for commands that do not depend on the path.
#include <cmath>

#include "mrpbench_local/dwb/critics.hpp"

namespace mrpbench::local {

namespace {

struct PreferForwardOptions {
  double penalty = 1, strafe_x = 0.1, strafe_theta = 0.2, theta_scale = 10;

  static Description<PreferForwardOptions> description() {
    using P = PreferForwardOptions;
    return {{"penalty", &P::penalty, "cost of driving back, and of driving slowly and nearly straight"},
            {"strafe_x", &P::strafe_x, any("m/s"), "speed below which a robot drives slowly"},
            {"strafe_theta", &P::strafe_theta, any("rad/s"), "turn rate below which driving is nearly straight"},
            {"theta_scale", &P::theta_scale, "cost of turning, per rad/s"}};
  }
};

class PreferForward : public Critic {
 public:
  using Options = PreferForwardOptions;
  explicit PreferForward(const Options& options) : options_(options) {}

  bool score(const Scene&, const Trajectories& all, std::span<double> raw, std::span<Reason>) override {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Twist twist = all.twist(i);
      const double rate = std::abs(twist.turn);
      const bool creeps = twist.ahead < 0 || (twist.ahead < options_.strafe_x && rate < options_.strafe_theta);
      raw[i] = creeps ? options_.penalty : rate * options_.theta_scale;
    }
    return false;
  }

 private:
  Options options_;
};

class Twirling : public Critic {
 public:
  struct Options {
    static Description<Options> description() { return {}; }
  };
  explicit Twirling(const Options&) {}

  bool score(const Scene&, const Trajectories& all, std::span<double> raw, std::span<Reason>) override {
    for (std::size_t i = 0; i < all.size(); ++i) raw[i] = std::abs(all.twist(i).turn);
    return false;
  }
};

}  // namespace

CriticKind prefer_forward() {
  return kind_of<PreferForward>();
}

CriticKind twirling() {
  return kind_of<Twirling>();
}

}  // namespace mrpbench::local
