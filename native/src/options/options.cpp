#include "mrpbench_options/options.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace mrpbench {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

std::string expected(const OptionInfo& option) {
  std::ostringstream text;
  switch (option.type) {
    case OptionInfo::Type::boolean:
      text << "true or false";
      break;
    case OptionInfo::Type::choice:
      text << "one of " << joined(option.choices);
      break;
    case OptionInfo::Type::integer:
    case OptionInfo::Type::real:
      text << (option.type == OptionInfo::Type::integer ? "a whole number" : "a number");
      if (option.range.least) {
        text << (option.range.above  ? " above "
                 : option.range.most ? " from "
                                     : " of at least ")
             << *option.range.least;
      }
      if (option.range.most) text << (option.range.least ? " to " : " of at most ") << *option.range.most;
  }
  if (option.optional) text << ", or none";
  return text.str();
}

std::string written(const OptionValue& value) {
  std::ostringstream text;
  if (const auto* flag = std::get_if<bool>(&value)) {
    text << (*flag ? "true" : "false");
  } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    text << *whole;
  } else if (const auto* number = std::get_if<double>(&value)) {
    text << *number;
  } else if (const auto* word = std::get_if<std::string>(&value)) {
    text << "'" << *word << "'";
  } else {
    text << "none";
  }
  return text.str();
}

/// NaN is not within.
template <class T>
bool is_within(T value, const ValueRange& range) {
  const auto number = static_cast<double>(value);
  if (range.above && number <= *range.least) return false;
  return number >= range.least.value_or(-std::numeric_limits<double>::infinity()) &&
         number <= range.most.value_or(std::numeric_limits<double>::infinity());
}

bool fits(const OptionInfo& option, const OptionValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return option.optional;
  switch (option.type) {
    case OptionInfo::Type::boolean:
      return std::holds_alternative<bool>(value);
    case OptionInfo::Type::integer:
      return std::holds_alternative<std::int64_t>(value) && is_within(std::get<std::int64_t>(value), option.range);
    case OptionInfo::Type::real:
      return std::holds_alternative<double>(value) && is_within(std::get<double>(value), option.range);
    case OptionInfo::Type::choice:
      break;
  }
  const auto* const word = std::get_if<std::string>(&value);
  return word != nullptr && std::ranges::count(option.choices, *word) > 0;
}

}  // namespace

void OptionInfo::check(const OptionValue& value) const {
  if (!fits(*this, value))
    throw std::invalid_argument(name + " must be " + expected(*this) + ", not " + written(value));
}

}  // namespace mrpbench
