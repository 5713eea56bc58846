// A particle: one hypothesis about the pose of a robot.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "mrpbench_sim/frames.hpp"

namespace mrpbench::amcl {

using sim::composed;
using sim::Point;
using sim::Pose;
using sim::relative;
using sim::wrapped;

struct Particle {
  Pose pose;
  double weight = 0;
};

/// The cell of the histogram in which a pose lies: half a metre wide, and ten degrees, which are 36 to a turn.
struct Bin {
  static constexpr double kWidth = 0.5;
  static constexpr int kTurn = 36;

  std::int64_t column = 0, row = 0, turn = 0;

  static Bin of(Pose pose) {
    const double turn = std::floor((wrapped(pose.yaw) + std::numbers::pi) / (2 * std::numbers::pi / kTurn));
    return {static_cast<std::int64_t>(std::floor(pose.x / kWidth)),
            static_cast<std::int64_t>(std::floor(pose.y / kWidth)), static_cast<std::int64_t>(turn) % kTurn};
  }
  bool operator==(const Bin&) const = default;
};

struct BinHash {
  std::size_t operator()(const Bin& bin) const {
    const auto mixed = static_cast<std::uint64_t>(bin.column) * 0x9E3779B97F4A7C15u +
                       static_cast<std::uint64_t>(bin.row) * 0xC2B2AE3D27D4EB4Fu + static_cast<std::uint64_t>(bin.turn);
    return static_cast<std::size_t>(mixed ^ (mixed >> 29));
  }
};

}  // namespace mrpbench::amcl
