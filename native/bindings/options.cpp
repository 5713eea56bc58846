// Python bindings of the options of components.
#include "options.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;
using namespace mrpbench;
using namespace mrpbench::bindings;

namespace {

/// The Python type that a row stands for.
const char* type_name(OptionInfo::Type type) {
  switch (type) {
    case OptionInfo::Type::boolean:
      return "bool";
    case OptionInfo::Type::integer:
      return "int";
    case OptionInfo::Type::real:
      return "float";
    case OptionInfo::Type::choice:
      break;
  }
  return "str";
}

}  // namespace

NB_MODULE(options, module) {
  module.doc() = "The options of components in C++.";

  nb::class_<Parameter>(module, "Option", "An option of a component.")
      .def_prop_ro(
          "name", [](const Parameter& it) { return it.info.name; }, "The word that sets it.")
      .def_prop_ro(
          "type", [](const Parameter& it) { return type_name(it.info.type); }, "bool, int, float or str.")
      .def_prop_ro(
          "optional", [](const Parameter& it) { return it.info.optional; }, "It may be None.")
      .def_prop_ro(
          "default", [](const Parameter& it) { return to_python(it.preset); }, "Its value unless it is set.")
      .def_prop_ro(
          "least", [](const Parameter& it) { return it.info.range.least; }, "Of numbers, None if unbounded.")
      .def_prop_ro(
          "above", [](const Parameter& it) { return it.info.range.above; }, "`least` itself is excluded.")
      .def_prop_ro(
          "most", [](const Parameter& it) { return it.info.range.most; }, "Of numbers, None if unbounded.")
      .def_prop_ro(
          "unit", [](const Parameter& it) { return it.info.range.unit; }, "Of numbers, an empty text if none.")
      .def_prop_ro(
          "choices", [](const Parameter& it) { return it.info.choices; }, "The words it may be; [] for other types.")
      .def_prop_ro(
          "help", [](const Parameter& it) { return it.info.help; }, "One sentence, without a full stop.")
      .def_prop_ro(
          "paper", [](const Parameter& it) { return it.info.paper; }, "Short citation, or an empty text.")
      .def_ro("fixed", &Parameter::fixed, "The name of the component decides it; plugins do not offer it.");
}
