#include "mrpbench_tracking/predict.hpp"

namespace mrpbench::tracking {

Places by_constant_velocity(std::span<const Walker> objects, double step, std::size_t count) {
  Places places;
  places.reserve(objects.size() * count);
  for (const Walker& it : objects) {
    for (std::size_t k = 0; k < count; ++k) {
      places.push_back(it.place + it.velocity * (step * static_cast<double>(k)));
    }
  }
  return places;
}

Places by_social_force(std::span<const Walker> objects, double radius, const std::vector<Segment>& walls,
                       std::span<const Point> robots, std::span<const double> robot_radius, double step,
                       std::size_t count) {
  const std::size_t size = objects.size();
  if (size == 0) return {};
  std::vector<double> speed;
  std::vector<Point> places, wanted;
  for (const Walker& it : objects) {
    places.push_back(it.place);
    wanted.push_back(it.velocity);
    speed.push_back(length(it.velocity));
  }
  sim::Walkers walkers(walls, std::vector<double>(size, radius), std::move(speed), std::vector<int>(size, -1),
                       std::move(places), {}, wanted);
  const std::vector<Point> push(size);
  const std::vector<unsigned char> regard(size, sim::Walkers::as_people);
  std::vector<Walker> others;
  for (const Point it : robots) others.push_back({it, {}});
  Places predicted(size * count);
  for (std::size_t k = 0; k < count; ++k) {
    if (k > 0) walkers.step(step, {wanted, push, regard}, others, robot_radius, others.size(), {});
    for (std::size_t i = 0; i < size; ++i) predicted[i * count + k] = walkers.places()[i];
  }
  return predicted;
}

}  // namespace mrpbench::tracking
