// NumPy arrays as C++ sees them: what the modules for robots in the plane take, row by row, without copying.
#pragma once

#include <nanobind/ndarray.h>

#include <span>
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

inline void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace mrpbench::bindings
