#include "mrpbench_slam/pose_graph.hpp"

#include "envelope.hpp"

namespace mrpbench::slam {

namespace {

constexpr int kMostSteps = 50;
/// Share of the cost, or cost, below which an improvement ends the search; and the largest move that does.
constexpr double kImprovement = 1e-10, kStill = 1e-9;

/// The error of a constraint in the frame that it measures, and its derivatives by both poses, row by row.
struct Error {
  double value[3], by_from[9], by_to[9];
};

Error error_of(Pose from, Pose to, const Constraint& it) {
  const double c = std::cos(from.yaw), s = std::sin(from.yaw), x = to.x - from.x, y = to.y - from.y;
  const double cz = std::cos(it.measured.yaw), sz = std::sin(it.measured.yaw);
  const double u = c * x + s * y - it.measured.x, v = c * y - s * x - it.measured.y;
  // rows of the rotation into the frame, and the derivative of (u, v) by the yaw of `from`
  const double a = cz * c - sz * s, b = cz * s + sz * c, du = c * y - s * x, dv = -c * x - s * y;
  Error e{};
  e.value[0] = cz * u + sz * v;
  e.value[1] = cz * v - sz * u;
  e.value[2] = wrapped(to.yaw - from.yaw - it.measured.yaw);
  const double by_to[9] = {a, b, 0, -b, a, 0, 0, 0, 1};
  const double by_from[9] = {-a, -b, cz * du + sz * dv, b, -a, cz * dv - sz * du, 0, 0, -1};
  std::copy_n(by_to, 9, e.by_to);
  std::copy_n(by_from, 9, e.by_from);
  return e;
}

double squared(const double (&e)[3], const Information& information) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) sum += e[i] * information[3 * i + j] * e[j];
  }
  return sum;
}

/// Half of the loss of a squared error, and the weight of its square in the next step.
struct Loss {
  double value, weight;
};

Loss loss_of(double squares, double huber) {
  const double size = std::sqrt(squares);
  if (huber <= 0 || size <= huber) return {0.5 * squares, 1};
  return {huber * (size - 0.5 * huber), huber / size};
}

/// The rows of each node begin at the first free node that it has a constraint with.
Envelope envelope_of(std::size_t nodes, const std::vector<Constraint>& constraints, std::size_t fixed) {
  std::vector<std::size_t> first(nodes);
  for (std::size_t i = 0; i < nodes; ++i) first[i] = i;
  for (const Constraint& it : constraints) {
    const auto [low, high] = std::minmax(it.from, it.to);
    first[high] = std::min(first[high], low);
  }
  std::vector<std::size_t> rows;
  for (std::size_t i = fixed; i < nodes; ++i) {
    for (int k = 0; k < 3; ++k) rows.push_back(3 * (std::max(first[i], fixed) - fixed));
  }
  return Envelope(std::move(rows));
}

/// Add `left' W right` to the block of two free nodes; only the lower half of the matrix is kept.
void add_block(Envelope& matrix, std::size_t row, std::size_t column, const double (&left)[9], const double (&right)[9],
               const Information& weight) {
  if (row < column) return;
  double half[9] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) half[3 * i + j] += left[3 * k + i] * weight[3 * k + j];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (row == column && j > i) continue;
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += half[3 * i + k] * right[3 * k + j];
      matrix.at(3 * row + i, 3 * column + j) += sum;
    }
  }
}

void add_gradient(std::vector<double>& right, std::size_t node, const double (&by)[9], const double (&weighted)[3]) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) right[3 * node + i] -= by[3 * k + i] * weighted[k];
  }
}

void linearise(const std::vector<Pose>& poses, const std::vector<Constraint>& constraints, std::size_t fixed,
               Envelope& matrix, std::vector<double>& right) {
  matrix.clear();
  std::fill(right.begin(), right.end(), 0.0);
  for (const Constraint& it : constraints) {
    if (it.from < fixed && it.to < fixed) continue;
    const Error e = error_of(poses[it.from], poses[it.to], it);
    Information weight = it.information;
    const double factor = loss_of(squared(e.value, it.information), it.huber).weight;
    for (double& value : weight) value *= factor;
    double weighted[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) weighted[i] += weight[3 * i + j] * e.value[j];
    }
    const bool moves_from = it.from >= fixed, moves_to = it.to >= fixed;
    const std::size_t from = it.from - fixed, to = it.to - fixed;
    if (moves_from) {
      add_block(matrix, from, from, e.by_from, e.by_from, weight);
      add_gradient(right, from, e.by_from, weighted);
    }
    if (moves_to) {
      add_block(matrix, to, to, e.by_to, e.by_to, weight);
      add_gradient(right, to, e.by_to, weighted);
    }
    if (moves_from && moves_to) {
      add_block(matrix, to, from, e.by_to, e.by_from, weight);
      add_block(matrix, from, to, e.by_from, e.by_to, weight);
    }
  }
}

}  // namespace

double cost_of(const std::vector<Pose>& poses, const std::vector<Constraint>& constraints) {
  double sum = 0;
  for (const Constraint& it : constraints) {
    const Error e = error_of(poses[it.from], poses[it.to], it);
    sum += loss_of(squared(e.value, it.information), it.huber).value;
  }
  return sum;
}

double optimise(std::vector<Pose>& poses, const std::vector<Constraint>& constraints, std::size_t fixed) {
  double cost = cost_of(poses, constraints), damping = 1e-6;
  if (poses.size() <= fixed) return cost;
  Envelope matrix = envelope_of(poses.size(), constraints, fixed);
  std::vector<double> right(matrix.size());
  std::vector<Pose> moved = poses;
  for (int step = 0; step < kMostSteps; ++step) {
    linearise(poses, constraints, fixed, matrix, right);
    for (std::size_t i = 0; i < matrix.size(); ++i) matrix.at(i, i) += damping * matrix.at(i, i) + 1e-12;
    double largest = 0;
    double found = cost;
    if (matrix.decompose()) {
      matrix.solve(right);
      for (std::size_t i = fixed; i < poses.size(); ++i) {
        const double* move = right.data() + 3 * (i - fixed);
        moved[i] = {poses[i].x + move[0], poses[i].y + move[1], wrapped(poses[i].yaw + move[2])};
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(move[k]));
      }
      found = cost_of(moved, constraints);
    }
    if (!(found < cost)) {
      if (largest < kStill || damping > 1e6) break;
      damping = std::max(damping * 10, 1e-4);
      continue;
    }
    const double gained = cost - found;
    poses = moved;
    cost = found;
    damping *= 0.1;
    if (largest < kStill || gained < kImprovement * (cost + kImprovement)) break;
  }
  return cost;
}

}  // namespace mrpbench::slam
