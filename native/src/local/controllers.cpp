// The controllers by their names.
#include <stdexcept>

#include "mrpbench_local/controller.hpp"

namespace mrpbench::local {

const ControllerKind& controller_kind(const std::string& name) {
  static const std::map<std::string, ControllerKind> kinds{
      {"dwb", dwb()},
      {"graceful", graceful()},
      {"mppi", mppi_controller()},
      {"rpp", rpp()},
  };
  const auto kind = kinds.find(name);
  if (kind == kinds.end()) throw std::invalid_argument("there is no controller " + name);
  return kind->second;
}

}  // namespace mrpbench::local
