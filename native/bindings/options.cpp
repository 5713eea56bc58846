// Python bindings of the options of components.
#include "options.hpp"

NB_MODULE(options, module) {
  module.doc() = "The options of components in C++.";
  mrpbench::bindings::bind_options(module);
}
