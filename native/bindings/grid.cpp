// Python bindings of robots on maps of cells: arrays in, arrays written. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>

#include "arrays.hpp"
#include "mrpbench_grid/cells.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::grid;

namespace {

template <class T>
using Output = nb::ndarray<T, nb::c_contig, nb::device::cpu>;
template <class T>
using Input = nb::ndarray<const T, nb::c_contig, nb::device::cpu>;

template <class Array>
auto flat(const Array& array) {
  return std::span{array.data(), array.size()};
}

/// Maps, and the array that holds them.
class Maps {
 public:
  Maps(const Vector<bool>& blocked, Place height, Place width)
      : kept_(blocked), cells_({reinterpret_cast<const std::uint8_t*>(blocked.data()), blocked.size()}, height, width) {
    require(height > 0 && width > 0 && blocked.size() > 0, "maps should have rows and columns");
    require(blocked.size() % static_cast<std::size_t>(height * width) == 0, "blocked does not hold whole maps");
    require(blocked.size() < (1U << 31), "there should be less than 2^31 cells");
  }

  std::size_t soft(const Input<bool>& active, const Input<Place>& place, const Input<Place>& wish,
                   const Output<Place>& to) {
    require(active.size() == place.size() && wish.size() == place.size() && to.size() == place.size(),
            "arrays should have one value for each robot");
    check(place, 0);
    check(wish, 0);
    return cells_.soft(flat(active), flat(place), flat(wish), flat(to));
  }

  void overwritten(const Input<bool>& active, const Input<Place>& place, const Input<Place>& to,
                   const Output<bool>& found) {
    require(active.size() == place.size() && to.size() == place.size() && found.size() == place.size(),
            "arrays should have one value for each robot");
    check(place, 0);
    check(to, 0);
    cells_.overwritten(flat(active), flat(place), flat(to), flat(found));
  }

  void free_actions(const Input<Place>& place, const Output<std::uint8_t>& bits) const {
    require(bits.size() == place.size(), "arrays should have one value for each robot");
    check(place, 1);
    cells_.free_actions(flat(place), flat(bits));
  }

  void distances(Place goal, const Output<std::int32_t>& steps) {
    require(goal >= 0 && static_cast<std::size_t>(goal) < cells_.size(), "a place is outside of the maps");
    require(steps.size() == static_cast<std::size_t>(cells_.height() * cells_.width()),
            "steps should be those of a map");
    cells_.distances(goal, flat(steps));
  }

  void pogema(const Input<bool>& shown, const Input<Place>& place, const Input<Place>& goal, Place radius,
              const Output<float>& windows) {
    const auto side = static_cast<std::size_t>(2 * radius + 1);
    require(radius > 0 && windows.size() == 3 * side * side * place.size(), "windows have another size");
    require(shown.size() == place.size() && goal.size() == place.size(), "arrays should have one value for each robot");
    check(place, radius);
    check(goal, 0);
    cells_.pogema(flat(shown), flat(place), flat(goal), radius, flat(windows));
  }

 private:
  /// Refuses places that have no window of a radius around them.
  void check(const Input<Place>& places, Place radius) const {
    const Place margin = radius * (cells_.width() + 1), last = static_cast<Place>(cells_.size()) - margin;
    for (std::size_t i = 0; i < places.size(); ++i)
      require(places.data()[i] >= margin && places.data()[i] < last, "a place is outside of the maps");
  }

  Vector<bool> kept_;
  Cells cells_;
};

}  // namespace

NB_MODULE(grid, module) {
  module.doc() = "Robots on maps of cells, in C++.";

  nb::class_<Maps>(module, "Maps")
      .def(nb::init<const Vector<bool>&, Place, Place>(), "blocked"_a.noconvert(), "height"_a, "width"_a)
      .def("soft", &Maps::soft, "active"_a.noconvert(), "place"_a.noconvert(), "wish"_a.noconvert(), "to"_a.noconvert())
      .def("overwritten", &Maps::overwritten, "active"_a.noconvert(), "place"_a.noconvert(), "to"_a.noconvert(),
           "found"_a.noconvert())
      .def("free_actions", &Maps::free_actions, "place"_a.noconvert(), "bits"_a.noconvert())
      .def("distances", &Maps::distances, "goal"_a, "steps"_a.noconvert())
      .def("pogema", &Maps::pogema, "shown"_a.noconvert(), "place"_a.noconvert(), "goal"_a.noconvert(), "radius"_a,
           "windows"_a.noconvert());
}
