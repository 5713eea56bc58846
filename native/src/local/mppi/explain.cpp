// What led to a command of MPPI.
#include <numeric>

#include "mrpbench_local/mppi/mppi.hpp"

namespace mrpbench::local {

using namespace mppi;

void mppi::add_trajectories(const Batch& batch, std::size_t every, std::size_t step, Samples& to) {
  const std::size_t columns = (batch.steps() + step - 1) / step;
  for (std::size_t k = (every - batch.first % every) % every; k < batch.samples(); k += every) {
    for (std::size_t t = 0; t < batch.steps(); t += step) {
      const Pose pose = batch.in_map(batch.x[t][k], batch.y[t][k], batch.yaw[t][k]);
      to.twist.values.insert(to.twist.values.end(), {batch.vx[t][k], batch.wz[t][k]});
      to.pose.values.insert(to.pose.values.end(), {pose.x, pose.y, pose.yaw});
    }
  }
  const std::size_t rows = to.pose.values.size() / (3 * columns);
  to.twist.shape = {rows, columns, 2};
  to.pose.shape = {rows, columns, 3};
}

/// What each critic, and then those of the caller if there are some, contributes to the mean total of the plan.
std::vector<double> Mppi::mean_scores() const {
  const std::size_t samples = total_.size();
  const auto mean = [&](const std::vector<float>& of) {
    return std::inner_product(of.begin(), of.end(), weight_.begin(), 0.0);
  };
  std::vector<double> found;
  std::vector<float> scores(samples);
  for (std::size_t c = 0; c < critics_.size(); ++c) {
    std::fill(scores.begin(), scores.end(), 0.0f);
    if (critics_[c].weight != 0) critics_[c].add(std::span<const float>(raw_).subspan(c * samples, samples), scores);
    found.push_back(mean(scores));
  }
  if (!added_.empty()) found.push_back(mean(added_));
  return found;
}

Explanation Mppi::explain() const {
  Explanation found;
  found.words["reason"] = {fault_};
  if (!scored_) return found;
  constexpr std::size_t every = 5;
  Batch batch = batch_;
  Samples samples;
  each_block(batch, [&] {
    sample(batch);
    add_trajectories(batch, every, 3, samples);
  });
  found.arrays = {{"twist", std::move(samples.twist)},
                  {"pose", std::move(samples.pose)},
                  {"score", {{raw_.begin(), raw_.end()}, {critics_.size(), total_.size()}}},
                  {"total", {{total_.begin(), total_.end()}, {total_.size()}}}};
  Array& plan = found.arrays["plan"];
  for (std::size_t t = 0; t < plan_vx_.size(); ++t) plan.values.insert(plan.values.end(), {plan_vx_[t], plan_wz_[t]});
  plan.shape = {plan_vx_.size(), 2};
  for (const WeightedCritic& it : critics_) found.words["critics"].push_back(it.name);
  Array& cost = found.arrays["cost"];
  for (std::size_t k = 0; k < total_.size(); k += every) cost.values.push_back(total_[k]);
  cost.shape = {cost.values.size()};
  if (*fault_) return found;
  Array& chosen = found.arrays["chosen"];
  const auto add = [&](Pose pose) {
    chosen.values.insert(chosen.values.end(), {pose.x, pose.y, pose.yaw});
    return true;
  };
  add(batch_.robot);
  walk(plan_vx_.size(), add);
  chosen.shape = {chosen.values.size() / 3, 3};
  Array& scores = found.arrays["chosen_score"];
  scores.values = mean_scores();
  scores.shape = {scores.values.size()};
  return found;
}

}  // namespace mrpbench::local
