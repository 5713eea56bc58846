#include "mrpbench_local/dwb/turns.hpp"

#include <cstring>

#include "mrpbench_common/wide.hpp"

namespace mrpbench::local {

namespace {

/// Numbers of neighbouring columns, which are computed together.
using Block = double __attribute__((vector_size(Turns::kBlock * sizeof(double))));

void load(Block& block, const double* from) {
  std::memcpy(&block, from, sizeof block);
}

void store(double* to, const Block& block) {
  std::memcpy(to, &block, sizeof block);
}

/// Whether a comparison of blocks holds anywhere.
template <class Lanes>
inline bool any(const Lanes& lanes) {
  auto found = lanes[0];
  for (std::size_t i = 1; i < Turns::kBlock; ++i) found |= lanes[i];
  return found != 0;
}

/// The first `n` terms of the series of sin(x) / x and of cos(x) by the square of x.
template <int n>
inline void sine_cosine(const Block& squared, Block& sine, Block& cosine) {
  sine = Block{} + 1.0;
  cosine = Block{} + 1.0;
  for (int k = n; k > 0; --k) {
    sine = 1.0 - sine * squared * (1.0 / (2 * k * (2 * k + 1)));
    cosine = 1.0 - cosine * squared * (1.0 / ((2 * k - 1) * 2 * k));
  }
}

}  // namespace

void Turns::begin(double yaw, std::optional<double> rate, std::span<const double> rates) {
  first_yaw_ = yaw;
  first_heading_ = {std::cos(yaw), std::sin(yaw)};
  first_rate_ = rate;
  rates_ = rates;
  stride_ = (rates.size() + kBlock - 1) / kBlock * kBlock;
  for (auto* it :
       {&count_, &dt_, &yaw_, &heading_x_, &heading_y_, &total_x_, &total_y_, &from_, &angle_, &by_x_, &by_y_}) {
    it->assign(stride_, 0.0);
  }
}

/// Take the steps of a column up to the one that reaches its turn rate.
void Turns::accelerate(std::size_t column, int count, double time, Limits limits) {
  const double dt = time / count, rate = rates_[column];
  double yaw = first_yaw_, now = first_rate_.value_or(rate);
  Point heading = first_heading_, sum;
  int k = 0;
  for (; k < count && now != rate; ++k) {
    now = project(now, limits.acceleration, limits.deceleration, dt, rate);
    sum = sum + heading;
    sum_x_[row(k + 1) + column] = sum.x;
    sum_y_[row(k + 1) + column] = sum.y;
    yaw += now * dt;
    heading = {std::cos(yaw), std::sin(yaw)};
  }
  count_[column] = count;
  dt_[column] = dt;
  yaw_[column] = yaw;
  heading_x_[column] = heading.x;
  heading_y_[column] = heading.y;
  total_x_[column] = sum.x;
  total_y_[column] = sum.y;
  from_[column] = k;
  angle_[column] = rate * dt;
  by_x_[column] = std::cos(rate * dt);
  by_y_[column] = std::sin(rate * dt);
}

/// Take the other steps of a block of columns, each from its own: each heading is the last one turned by the same
/// angle.
MRPBENCH_WIDE void Turns::spin(std::size_t column) {
  Block from, to, angle, by_x, by_y, x, y, yaw, total_x, total_y;
  load(from, &from_[column]);
  load(to, &count_[column]);
  load(angle, &angle_[column]);
  load(by_x, &by_x_[column]);
  load(by_y, &by_y_[column]);
  load(x, &heading_x_[column]);
  load(y, &heading_y_[column]);
  load(yaw, &yaw_[column]);
  load(total_x, &total_x_[column]);
  load(total_y, &total_y_[column]);
  double first = from[0], last = to[0];
  for (std::size_t i = 1; i < kBlock; ++i) {
    first = std::min(first, from[i]);
    last = std::max(last, to[i]);
  }
  std::size_t after = row(static_cast<int>(first) + 1) + column;
  for (double step = first; step < last; ++step, after += stride_) {
    const auto on = (from <= step) & (to > step);
    Block sum_x, sum_y;
    load(sum_x, &sum_x_[after]);
    load(sum_y, &sum_y_[after]);
    total_x = on ? total_x + x : total_x;
    total_y = on ? total_y + y : total_y;
    store(&sum_x_[after], on ? total_x : sum_x);
    store(&sum_y_[after], on ? total_y : sum_y);
    yaw = on ? yaw + angle : yaw;
    const Block turned_x = x * by_x - y * by_y, turned_y = x * by_y + y * by_x;
    x = on ? turned_x : x;
    y = on ? turned_y : y;
  }
  store(&from_[column], to);
  store(&heading_x_[column], x);
  store(&heading_y_[column], y);
  store(&yaw_[column], yaw);
  store(&total_x_[column], total_x);
  store(&total_y_[column], total_y);
}

void Turns::step(std::span<const int> counts, int least, double time, Limits limits) {
  const int most = std::max(least, *std::max_element(counts.begin(), counts.end()));
  if (sum_x_.size() < row(most + 1)) {
    sum_x_.resize(row(most + 1));
    sum_y_.resize(row(most + 1));
  }
  for (std::size_t first = 0; first < rates_.size(); first += kBlock) {
    bool changed = false;
    for (std::size_t i = first; i < std::min(first + kBlock, rates_.size()); ++i) {
      const int count = std::max(counts[i], least);
      if (count_[i] == count) continue;
      accelerate(i, count, time, limits);
      changed = true;
    }
    if (changed) spin(first);
  }
}

bool Turns::estimate(std::span<const int> counts, int least, double time, Limits limits, int changing) {
  // A rate is reached in one step more than it takes by `limits`, and there is one row before the first step.
  if (const std::size_t rows = row(kMostSteps + 2); sum_x_.size() < rows) {
    sum_x_.resize(rows);
    sum_y_.resize(rows);
  }
  for (std::size_t first = 0; first < stride_; first += kBlock) {
    bool changed = false;
    const std::size_t end = std::min(first + kBlock, rates_.size());
    if (const int fewest = *std::min_element(&counts[first], counts.data() + end); fewest >= least && count_[first] > 0)
      continue;
    for (std::size_t i = first; i < first + kBlock; ++i) {
      const double count = i < rates_.size() ? std::max(counts[i], least) : 1;
      changed = changed || count_[i] != count;
      count_[i] = count;
      if (i < rates_.size()) from_[i] = rates_[i];
    }
    if (changed && !estimate_block(first, time, limits, changing)) return false;
  }
  return true;
}

/// Step by step while rates or speeds change; the rest is a geometric series of unit vectors.
MRPBENCH_WIDE bool Turns::estimate_block(std::size_t column, double time, Limits limits, int changing) {
  Block count, rate;
  load(count, &count_[column]);
  load(rate, &from_[column]);
  const Block dt = time / count, up = limits.acceleration * dt, down = limits.deceleration * dt;
  Block now = first_rate_ ? Block{} + *first_rate_ : rate;
  Block x = Block{} + first_heading_.x, y = Block{} + first_heading_.y, total_x{}, total_y{};
  int k = 0;
  for (;; ++k) {
    const auto on = count > k;
    if (k >= changing && !any(on & (now != rate))) break;
    if (k >= kMostSteps) return false;
    const Block raised = now + up, lowered = now + down;
    const Block next = now < rate ? (raised < rate ? raised : rate) : (lowered > rate ? lowered : rate);
    const Block angle = next * dt;
    if (any(on & (angle * angle > 0.25))) return false;
    Block sine, cosine;
    sine_cosine<5>(angle * angle, sine, cosine);
    sine *= angle;
    total_x = on ? total_x + x : total_x;
    total_y = on ? total_y + y : total_y;
    store(&sum_x_[row(k + 1) + column], total_x);
    store(&sum_y_[row(k + 1) + column], total_y);
    const Block turned_x = x * cosine - y * sine, turned_y = x * sine + y * cosine;
    x = on ? turned_x : x;
    y = on ? turned_y : y;
    now = on ? next : now;
  }
  // The sum of the unit vectors at 0, a, ..., (left - 1) a: one of length sin(left a / 2) / sin(a / 2) at the middle.
  const Block left = count > k ? count - k : Block{}, half = rate * dt * 0.5, whole = left * half;
  if (any(half * half > 0.0625)) return false;
  Block sine, cosine, sine_half, cosine_half;
  sine_cosine<11>(whole * whole, sine, cosine);
  sine_cosine<5>(half * half, sine_half, cosine_half);
  const Block length = left * sine / sine_half;
  sine *= whole;
  sine_half *= half;
  const Block middle_x = cosine * cosine_half + sine * sine_half, middle_y = sine * cosine_half - cosine * sine_half;
  store(&total_x_[column], total_x + (x * middle_x - y * middle_y) * length);
  store(&total_y_[column], total_y + (x * middle_y + y * middle_x) * length);
  const Block turned_x = cosine * cosine - sine * sine, turned_y = 2.0 * sine * cosine;
  store(&heading_x_[column], x * turned_x - y * turned_y);
  store(&heading_y_[column], x * turned_y + y * turned_x);
  store(&dt_[column], dt);
  return true;
}

/// A step changes the speed of the columns that have it and are not as fast as wanted.
MRPBENCH_WIDE void Turns::drive(double now, double wanted, Limits limits, double* to_x, double* to_y) const {
  for (std::size_t first = 0; first < stride_; first += kBlock) {
    Block count, dt, x{}, y{}, at_x{}, at_y{}, speed = Block{} + now;
    load(count, &count_[first]);
    load(dt, &dt_[first]);
    const Block up = limits.acceleration * dt, down = limits.deceleration * dt;
    for (int k = 1;; ++k) {
      const auto on = (speed != wanted) & (count >= k);
      if (!any(on)) break;
      Block sum_x, sum_y;
      load(sum_x, &sum_x_[row(k) + first]);
      load(sum_y, &sum_y_[row(k) + first]);
      const Block raised = speed + up, lowered = speed + down, end = Block{} + wanted;
      const Block next = speed < wanted ? (raised < wanted ? raised : end) : (lowered > wanted ? lowered : end);
      speed = on ? next : speed;
      x = on ? x + (sum_x - at_x) * speed : x;
      y = on ? y + (sum_y - at_y) * speed : y;
      at_x = on ? sum_x : at_x;
      at_y = on ? sum_y : at_y;
    }
    Block total_x, total_y;
    load(total_x, &total_x_[first]);
    load(total_y, &total_y_[first]);
    store(to_x + first, (x + (total_x - at_x) * wanted) * dt);
    store(to_y + first, (y + (total_y - at_y) * wanted) * dt);
  }
}

}  // namespace mrpbench::local
