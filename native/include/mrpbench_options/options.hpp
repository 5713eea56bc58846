// The options of a component by name. Each option is one row in the struct that holds it; ranges, error messages, the
// Python interface and the options of plugins follow from the row.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mrpbench {

/// The value of an option; `std::monostate` is "none", for options that may be left open.
using OptionValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;
using OptionValues = std::map<std::string, OptionValue>;

/// The values from `least` to `most`, both included unless `above` excludes `least`, in a unit ("m"; empty = none).
struct ValueRange {
  std::optional<double> least, most;
  bool above = false;
  std::string unit;
  std::optional<std::pair<double, double>> usual;  // where a search looks for better values

  ValueRange usually(double low, double high) && {
    usual = {low, high};
    return std::move(*this);
  }
};
inline ValueRange any(std::string unit) {
  return {std::nullopt, std::nullopt, false, std::move(unit), std::nullopt};
}
inline ValueRange at_least(double least, std::string unit = "") {
  return {least, std::nullopt, false, std::move(unit), std::nullopt};
}
inline ValueRange above(double least, std::string unit = "") {
  return {least, std::nullopt, true, std::move(unit), std::nullopt};
}
inline ValueRange within(double least, double most, std::string unit = "") {
  return {least, most, false, std::move(unit), std::nullopt};
}

/// The description of an option, without the struct that holds it.
struct OptionInfo {
  enum class Type { boolean, integer, real, choice };

  std::string name;
  Type type = Type::boolean;
  bool optional = false;             // may be none
  ValueRange range;                  // of numbers
  std::vector<std::string> choices;  // of a choice
  std::string help;                  // one sentence, without a full stop
  std::string paper;                 // short citation, or empty

  /// Throws std::invalid_argument, in one line that names the option, for a value that it cannot have.
  void check(const OptionValue& value) const;
};

template <class Enum>
using Choices = std::vector<std::pair<std::string, Enum>>;

/// One row: an option and the field of `Options` that holds it.
template <class Options>
struct Option {
  OptionInfo info;
  std::function<OptionValue(const Options&)> get;
  std::function<void(Options&, const OptionValue&)> set;  // of a checked value

  template <class T>
  Option(std::string name, T Options::* field, std::string help, std::string paper = "")
      : Option(std::move(name), field, ValueRange{}, std::move(help), std::move(paper)) {}

  template <class T>
  Option(std::string name, T Options::* field, ValueRange range, std::string help, std::string paper = "")
      : info{std::move(name), type_of<T>(), is_optional<T>, range, {}, std::move(help), std::move(paper)} {
    if (info.type == OptionInfo::Type::integer && std::is_unsigned_v<T> && !range.least) info.range.least = 0;
    get = [field](const Options& options) -> OptionValue {
      if constexpr (is_optional<T>) {
        if (!(options.*field)) return std::monostate{};
        return static_cast<Stored<T>>(*(options.*field));
      } else {
        return static_cast<Stored<T>>(options.*field);
      }
    };
    set = [field](Options& options, const OptionValue& value) {
      if constexpr (is_optional<T>) {
        if (std::holds_alternative<std::monostate>(value)) {
          options.*field = std::nullopt;
          return;
        }
      }
      options.*field = static_cast<Plain<T>>(std::get<Stored<T>>(value));
    };
  }

  template <class Enum>
  Option(std::string name, Enum Options::* field, Choices<Enum> choices, std::string help, std::string paper = "")
      : info{std::move(name), OptionInfo::Type::choice, false, {}, {}, std::move(help), std::move(paper)} {
    for (const auto& [word, _] : choices) info.choices.push_back(word);
    get = [field, choices](const Options& options) -> OptionValue {
      for (const auto& [word, value] : choices) {
        if (value == options.*field) return word;
      }
      return {};
    };
    set = [field, choices](Options& options, const OptionValue& value) {
      for (const auto& [word, choice] : choices) {
        if (word == std::get<std::string>(value)) options.*field = choice;
      }
    };
  }

  /// The row of a struct that `Outer` holds in `part`.
  template <class Outer>
  Option(const Option<Outer>& inner, Outer Options::* part)
      : info(inner.info),
        get([inner, part](const Options& options) { return inner.get(options.*part); }),
        set([inner, part](Options& options, const OptionValue& value) { inner.set(options.*part, value); }) {}

 private:
  template <class T>
  struct Unwrapped {
    using Type = T;
  };
  template <class T>
  struct Unwrapped<std::optional<T>> {
    using Type = T;
  };
  template <class T>
  using Plain = typename Unwrapped<T>::Type;
  template <class T>
  static constexpr bool is_optional = !std::is_same_v<T, Plain<T>>;
  template <class T>
  using Stored = std::conditional_t<std::is_same_v<Plain<T>, bool>, bool,
                                    std::conditional_t<std::is_integral_v<Plain<T>>, std::int64_t, double>>;
  template <class T>
  static constexpr OptionInfo::Type type_of() {
    if (std::is_same_v<Stored<T>, bool>) return OptionInfo::Type::boolean;
    return std::is_same_v<Stored<T>, double> ? OptionInfo::Type::real : OptionInfo::Type::integer;
  }
};

template <class Options>
using Description = std::vector<Option<Options>>;

/// Append the rows of the struct that `Options` holds in `part`.
template <class Options, class Part>
void append(Description<Options>& rows, const Description<Part>& inner, Part Options::* part) {
  for (const auto& row : inner) rows.emplace_back(row, part);
}

/// An option as its users see it.
struct Parameter {
  OptionInfo info;
  OptionValue preset;
  bool fixed = false;  // decided by the name of the component; plugins do not offer it
};

/// What `rows` describe, with the defaults of `preset`.
template <class Options>
std::vector<Parameter> parameters(const Description<Options>& rows, const Options& preset = {}) {
  std::vector<Parameter> found;
  for (const auto& row : rows) found.push_back({row.info, row.get(preset)});
  return found;
}

/// Options with `values` set. Throws std::invalid_argument, naming the option, for one that does not exist or a value
/// that it cannot have.
template <class Options>
Options configured(const Description<Options>& rows, const OptionValues& values, Options options = {}) {
  for (const auto& [name, value] : values) {
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&name = name](const auto& it) { return it.info.name == name; });
    if (row == rows.end()) throw std::invalid_argument("there is no option '" + name + "'");
    row->info.check(value);
    row->set(options, value);
  }
  return options;
}

}  // namespace mrpbench
