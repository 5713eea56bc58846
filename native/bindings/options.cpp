// Python bindings of the options of components.
#include "options.hpp"

NB_MODULE(options, module) {
  // Classes of plugins hold options until the process ends, when Python no longer collects them.
  nanobind::set_leak_warnings(false);
  module.doc() = "The options of components in C++.";
  mrpbench::bindings::bind_options(module);
}
