// Values of options between Python and C++. The row of an option in C++ decides which values are allowed.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "mrpbench_options/options.hpp"

namespace mrpbench::bindings {

namespace nb = nanobind;

inline nb::object to_python(const OptionValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return nb::bool_(*flag);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return nb::int_(*whole);
  if (const auto* number = std::get_if<double>(&value)) return nb::float_(*number);
  if (const auto* word = std::get_if<std::string>(&value)) return nb::str(word->c_str());
  return nb::none();
}

/// The value of an option from a Python object: integers are whole numbers of any type, numbers may be whole.
inline OptionValue from_python(nb::handle value, OptionInfo::Type wanted) {
  using Type = OptionInfo::Type;
  if (value.is_none()) return std::monostate{};
  if (PyBool_Check(value.ptr())) return value.ptr() == Py_True;
  if (PyUnicode_Check(value.ptr())) return nb::cast<std::string>(value);
  if (wanted == Type::integer && PyIndex_Check(value.ptr())) {
    const auto whole = nb::steal<nb::object>(PyNumber_Index(value.ptr()));
    const std::int64_t found = whole.is_valid() ? PyLong_AsLongLong(whole.ptr()) : -1;
    if (PyErr_Occurred() == nullptr) return found;
    PyErr_Clear();
    throw std::invalid_argument("is too large");
  }
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  throw std::invalid_argument("cannot be a " + std::string(nb::str(value.type()).c_str()));
}

inline OptionValues from_python(const nb::dict& given, const std::vector<Parameter>& options) {
  OptionValues values;
  for (const auto& [key, value] : given) {
    const auto name = nb::cast<std::string>(key);
    auto type = OptionInfo::Type::real;
    for (const Parameter& it : options) {
      if (it.info.name == name) type = it.info.type;
    }
    try {
      values[name] = from_python(value, type);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name + " " + error.what());
    }
  }
  return values;
}

/// Options with the values that a dict gives.
template <class Options>
Options configured_by(const nb::dict& given, const Description<Options>& rows = Options::description()) {
  return configured(rows, from_python(given, parameters(rows, Options{})), Options{});
}

/// The Python type that a row stands for.
inline const char* type_name(OptionInfo::Type type) {
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

/// Give a module the class of options.
inline void bind_options(nb::module_& module) {
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
          "usual", [](const Parameter& it) { return it.info.range.usual; },
          "Of numbers, from where to where a search looks for better values; None if nothing is said.")
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

/// Lets a module return options, whose Python class is in `mrpbench_native.options`.
inline void use_options() {
  nb::module_::import_("mrpbench_native.options");
}

}  // namespace mrpbench::bindings
