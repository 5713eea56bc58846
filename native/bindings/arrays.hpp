// NumPy arrays as C++ sees them, without copying.
#pragma once

#include <nanobind/ndarray.h>

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace mrpbench::bindings {

namespace nb = nanobind;

template <class T>
using Vector = nb::ndarray<const T, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <int columns>
using Matrix = nb::ndarray<const double, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;

/// The rows of an array as what they are.
template <class Row, class Array>
std::span<const Row> rows(const Array& array) {
  return {reinterpret_cast<const Row*>(array.data()), array.shape(0)};
}

template <class Row, class Array>
std::vector<Row> copy(const Array& array) {
  const auto found = rows<Row>(array);
  return {found.begin(), found.end()};
}

/// A new array that owns its values.
template <class T>
nb::ndarray<nb::numpy, T> own(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  auto* const kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* it) noexcept { delete static_cast<std::vector<T>*>(it); });
  return nb::ndarray<nb::numpy, T>(kept->data(), shape.size(), shape.begin(), owner);
}

/// What keeps arrays as long as it lasts.
template <class... Arrays>
std::shared_ptr<const void> keeping(const Arrays&... arrays) {
  return std::make_shared<std::tuple<Arrays...>>(arrays...);
}

inline void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

template <class T>
using Table = nb::ndarray<const T, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// Arrays by name. An array must have the right type: a conversion would wrap numbers that are too large.
class NamedArrays {
 public:
  NamedArrays(const nb::dict& arrays, const char* owner) : arrays_(arrays), owner_(owner) {}

  template <class T>
  Vector<T> vector(const char* name) const {
    return get<Vector<T>>(name);
  }
  template <class T>
  Table<T> table(const char* name) const {
    return get<Table<T>>(name);
  }
  /// `count` rows of so many columns, or any number of rows.
  template <int columns>
  Matrix<columns> rows(const char* name, std::optional<std::size_t> count = {}) const {
    const auto found = get<Matrix<columns>>(name);
    require(!count || found.shape(0) == *count, name, "has the wrong length");
    return found;
  }
  /// A vector of `size`.
  template <class T>
  Vector<T> vector(const char* name, std::size_t size) const {
    const auto found = vector<T>(name);
    require(found.size() == size, name, "has the wrong length");
    return found;
  }
  /// The bounds of `rows` lists that are stored one after another in `size` elements: list i is [first[i], first[i+1]).
  Vector<std::int64_t> bounds(const char* name, std::size_t rows, std::size_t size) const {
    const auto first = vector<std::int64_t>(name, rows + 1);
    bool sound = first.data()[0] == 0 && first.data()[rows] == static_cast<std::int64_t>(size);
    for (std::size_t i = 0; sound && i < rows; ++i) sound = first.data()[i] <= first.data()[i + 1];
    require(sound, name, "does not fit the lists that it bounds");
    return first;
  }
  void require(bool holds, const char* name, const char* fault) const {
    if (!holds) throw std::invalid_argument(full(name) + " " + fault);
  }

 private:
  std::string full(const char* name) const { return std::string(owner_) + "['" + name + "']"; }

  template <class Array>
  Array get(const char* name) const {
    if (!arrays_.contains(name)) throw nb::type_error((full(name) + " is missing").c_str());
    Array found;
    if (!nb::try_cast(arrays_[name], found, false)) {
      throw nb::type_error((full(name) + " has the wrong type or shape").c_str());
    }
    return found;
  }

  const nb::dict& arrays_;
  const char* owner_;
};

/// The attribute `name` of a Python object. Throws a TypeError that names it if it has the wrong type or shape.
template <class T>
T attribute(nb::handle object, const char* name) {
  T found;
  if (!nb::try_cast(object.attr(name), found))
    throw nb::type_error((std::string(name) + " has the wrong type or shape").c_str());
  return found;
}

}  // namespace mrpbench::bindings
