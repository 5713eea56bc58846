// Critics that look at velocities only.
#include <algorithm>
#include <cmath>

#include "mrpbench_common/wide.hpp"
#include "mrpbench_local/mppi/critic.hpp"

namespace mrpbench::local::mppi {

namespace {

/// Penalty for velocities beyond the limits.
class Constraint : public Critic {
 public:
  struct Options : Weighting {
    static Description<Options> description() { return {}; }
  };
  explicit Constraint(const Options&) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    add(batch, raw);
    return true;
  }

 private:
  MRPBENCH_WIDE static void add(const Batch& batch, std::span<float> raw) {
    const Limits& limit = batch.limits;
    for (std::size_t t = 0; t < batch.steps(); ++t) {
      const float* const vx = batch.vx[t];
      const float* const wz = batch.wz[t];
      MRPBENCH_NO_OVERLAP
      for (std::size_t k = 0; k < raw.size(); ++k) {
        raw[k] += batch.dt * std::max(0.0f, std::max(vx[k] - limit.vx_max, limit.vx_min - vx[k]));
      }
      if (limit.min_turning_r <= 0) continue;
      for (std::size_t k = 0; k < raw.size(); ++k) {
        const float radius = std::abs(vx[k]) / std::max(std::abs(wz[k]), 1e-6f);
        raw[k] += batch.dt * std::max(limit.min_turning_r - radius, 0.0f);
      }
    }
  }
};

/// Add the way back.
MRPBENCH_WIDE void add_reverse(const Batch& batch, std::span<float> raw) {
  for (std::size_t t = 0; t < batch.steps(); ++t) {
    const float* const vx = batch.vx[t];
    MRPBENCH_NO_OVERLAP
    for (std::size_t k = 0; k < raw.size(); ++k) raw[k] += std::max(0.0f, -batch.dt * vx[k]);
  }
}

/// Penalty for driving back.
class PreferForward : public Critic {
 public:
  struct Options : Weighting {
    double threshold_to_consider = 0.5;
    static Description<Options> description() {
      return {{"threshold_to_consider", &Options::threshold_to_consider, at_least(0, "m"),
               "act while more of the path is left"}};
    }
  };
  explicit PreferForward(const Options& options) : options_(options) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    if (batch.path.length < static_cast<float>(options_.threshold_to_consider)) return true;
    add_reverse(batch, raw);
    return true;
  }

 private:
  Options options_;
};

/// Penalty for turning.
class Twirling : public Critic {
 public:
  struct Options : Weighting {
    static Description<Options> description() { return {}; }
  };
  explicit Twirling(const Options&) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    if (batch.path.length < batch.tolerance) return true;
    const float share = 1.0f / static_cast<float>(batch.steps());
    for (std::size_t t = 0; t < batch.steps(); ++t) {
      const float* const wz = batch.wz[t];
      for (std::size_t k = 0; k < raw.size(); ++k) raw[k] += std::abs(wz[k]) * share;
    }
    return true;
  }
};

/// Penalty for velocities that the drive does not execute.
class VelocityDeadband : public Critic {
 public:
  struct Options : Weighting {
    double deadband_vx = 0, deadband_wz = 0;
    static Description<Options> description() {
      return {{"deadband_vx", &Options::deadband_vx, at_least(0, "m/s"), "lower speeds are not executed"},
              {"deadband_wz", &Options::deadband_wz, at_least(0, "rad/s"), "lower turn rates are not executed"}};
    }
  };
  explicit VelocityDeadband(const Options& options)
      : vx_(static_cast<float>(options.deadband_vx)), wz_(static_cast<float>(options.deadband_wz)) {}

  bool score(const Batch& batch, std::span<float> raw) override {
    for (std::size_t t = 0; t < batch.steps(); ++t) {
      const float* const vx = batch.vx[t];
      const float* const wz = batch.wz[t];
      for (std::size_t k = 0; k < raw.size(); ++k) {
        raw[k] += batch.dt * (std::max(vx_ - std::abs(vx[k]), 0.0f) + std::max(wz_ - std::abs(wz[k]), 0.0f));
      }
    }
    return true;
  }

 private:
  float vx_, wz_;
};

}  // namespace

CriticKind constraint_critic() {
  return kind_of<Constraint>(4);
}

CriticKind prefer_forward_critic() {
  return kind_of<PreferForward>(5);
}

CriticKind twirling_critic() {
  return kind_of<Twirling>(10);
}

CriticKind velocity_deadband_critic() {
  return kind_of<VelocityDeadband>(35);
}

}  // namespace mrpbench::local::mppi
