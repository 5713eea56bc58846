// From one configuration to the next.
#pragma once

#include <cstdint>

namespace mrpbench::mapf::lacam {

class ConfigurationGenerator {
 public:
  virtual ~ConfigurationGenerator() = default;

  /// Where all robots go from `from`: robot r to `to[r]` if that is no -1, the others where priority inheritance sends
  /// them, those first in `order` before the others. False if it finds no way for all; then `to` means nothing.
  virtual bool operator()(const std::int32_t* from, const std::int32_t* order, std::int32_t* to) = 0;

  /// From now on all robots go straight to their goals.
  virtual void drop_guide_paths() {}
};

}  // namespace mrpbench::mapf::lacam
