#include <stdexcept>

#include "epibt.hpp"
#include "pibt.hpp"

namespace mrpbench::discrete {

std::unique_ptr<Planner> make_planner(const PlannerOptions& options, std::uint64_t seed) {
  if (options.name == "pibt") return std::make_unique<Pibt>(seed);
  if (options.name == "epibt") return std::make_unique<Epibt>(options.depth, options.improve, options.threads, seed);
  throw std::invalid_argument("there is no planner " + options.name + "; known: pibt, epibt");
}

}  // namespace mrpbench::discrete
