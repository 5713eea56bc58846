// Python bindings of discrete executions: a problem in, arrays out. Nothing here decides anything.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <tuple>

#include "arrays.hpp"
#include "mrpbench_discrete/league.hpp"

namespace nb = nanobind;
using namespace mrpbench::bindings;
using namespace nb::literals;
using namespace mrpbench::discrete;

namespace {

template <class T>
using Output = nb::ndarray<nb::numpy, T>;

std::vector<std::int32_t> free_cells(const Grid& grid, const Vector<std::int32_t>& places, const char* what) {
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < places.size(); ++i) {
    found.push_back(grid.free_cell(places.data()[i]));
    if (found.back() < 0) throw std::invalid_argument(std::string(what) + " holds a cell that is not free");
  }
  return found;
}

Delays delays_of(const nb::handle& given) {
  Delays found;
  if (given.is_none()) return found;
  found.least = attribute<int>(given, "least");
  found.most = attribute<int>(given, "most");
  found.poisson = attribute<std::string>(given, "events") == "poisson";
  found.gaussian = attribute<std::string>(given, "durations") == "gaussian";
  found.probability = attribute<double>(given, "probability");
  found.mean_ratio = attribute<double>(given, "mean_ratio");
  found.deviation_ratio = attribute<double>(given, "deviation_ratio");
  found.seed = attribute<std::uint64_t>(given, "seed");
  return found;
}

/// A problem as `mrpbench_league.files.problem.LorrProblem` describes it.
Problem problem_of(nb::handle given) {
  const auto blocked = attribute<nb::ndarray<const bool, nb::ndim<2>, nb::c_contig, nb::device::cpu>>(given, "blocked");
  const Vector<std::int32_t> start = attribute<Vector<std::int32_t>>(given, "start"),
                             errands = attribute<Vector<std::int32_t>>(given, "errands"),
                             first = attribute<Vector<std::int32_t>>(given, "first");
  Grid grid({reinterpret_cast<const std::uint8_t*>(blocked.data()), blocked.size()}, static_cast<int>(blocked.shape(0)),
            static_cast<int>(blocked.shape(1)));
  const int season = attribute<int>(given, "season");
  require(season == 2023 || season == 2024 || season == 2026, "season should be 2023, 2024 or 2026");
  require(first.size() > 1 && first.data()[0] == 0, "first should begin with 0");
  for (std::size_t i = 1; i < first.size(); ++i)
    require(first.data()[i] > first.data()[i - 1], "first should increase");
  require(static_cast<std::size_t>(first.data()[first.size() - 1]) == errands.size(), "first should end with errands");
  const auto starts = free_cells(grid, start, "start"), cells = free_cells(grid, errands, "errands");
  require(!starts.empty(), "there should be a robot");
  std::vector<std::uint8_t> taken(grid.size(), 0);
  for (const int cell : starts) require(!taken[cell]++, "two robots start in one cell");
  Problem found{season, std::move(grid), starts, cells, copy<std::int32_t>(first)};
  found.visible = season == 2023 ? static_cast<int>(attribute<double>(given, "reveal")) : attribute<int>(given, "pool");
  found.strategy = attribute<std::string>(given, "strategy");
  found.counter = attribute<int>(given, "counter");
  found.size = attribute<double>(given, "size");
  require(found.visible > 0 && found.counter > 0 && found.size > 0 && found.size <= 1, "the problem is out of range");
  found.delays = delays_of(given.attr("delays"));
  return found;
}

std::unique_ptr<League> open(nb::handle problem, const std::string& planner, int depth, bool improve, int threads,
                             bool guidance, std::optional<int> active, double limit,
                             std::optional<std::int64_t> iterations, std::uint64_t seed, double preprocessing,
                             std::size_t table_mib, int period) {
  LeagueOptions options;
  options.planner = {planner, depth, improve, threads};
  options.guidance = guidance;
  options.active = active;
  options.limit_s = limit;
  options.iterations = iterations;
  options.seed = seed;
  options.preprocessing_s = preprocessing;
  options.table_bytes = table_mib << 20;
  options.period = period;
  require(threads > 0 && (!active || *active > 0), "threads or active are out of range");
  require(preprocessing >= 0 && table_mib > 0, "preprocessing or table_mib are out of range");
  require(limit > 0 && period > 0 && (!iterations || *iterations >= 0), "limit, period or iterations are out of range");
  Problem found = problem_of(problem);
  const nb::gil_scoped_release release;
  if (found.season == 2026) return make_ticks(std::move(found), std::move(options));
  return make_steps(std::move(found), std::move(options));
}

Output<std::int32_t> pose(const League& self) {
  std::vector<std::int32_t> found;
  const int width = self.problem().grid.width();
  for (const Pose& it : self.pose()) {
    const int place = self.problem().grid.place(it.cell);
    found.insert(found.end(), {place / width, place % width, it.heading});
  }
  return own(std::move(found), {self.pose().size(), 3});
}

Output<std::int32_t> events(const League& self) {
  std::vector<std::int32_t> found;
  for (const Event& it : self.tasks().events()) found.insert(found.end(), it.begin(), it.end());
  const std::size_t count = found.size() / 4;
  return own(std::move(found), {count, 4});
}

Output<std::int32_t> tasks(const League& self) {
  std::vector<std::int32_t> found;
  for (const Task& it : self.tasks().all()) found.insert(found.end(), {it.line, it.revealed, it.progress, it.opener});
  const std::size_t count = found.size() / 4;
  return own(std::move(found), {count, 4});
}

Output<std::int32_t> unexecuted(const League& self) {
  std::vector<std::int32_t> found;
  for (const auto& it : self.unexecuted()) found.insert(found.end(), it.begin(), it.end());
  return own(std::move(found), {self.unexecuted().size(), 3});
}

Output<std::int32_t> delays(const League& self) {
  std::vector<std::int32_t> found;
  if (const auto* const ticks = dynamic_cast<const Ticks*>(&self)) {
    std::int32_t robot = 0;
    for (const auto& intervals : ticks->delays()) {
      for (const auto& [start, end] : intervals) found.insert(found.end(), {robot, start, end});
      ++robot;
    }
  }
  const std::size_t count = found.size() / 3;
  return own(std::move(found), {count, 3});
}

Output<std::int32_t> segments(const League& self) {
  const auto* const ticks = dynamic_cast<const Ticks*>(&self);
  auto found = ticks ? ticks->segments() : std::vector<std::int32_t>{};
  const std::size_t robots = self.pose().size(), count = found.size() / (4 * robots);
  return own(std::move(found), {count, robots, 4});
}

}  // namespace

NB_MODULE(discrete, module) {
  module.doc() = "Discrete executions by the rules of the League of Robot Runners, in C++.";

  nb::class_<League>(module, "Execution")
      .def("run_until", &League::run_until, "time"_a, nb::call_guard<nb::gil_scoped_release>())
      .def_prop_ro("time", &League::time)
      .def_prop_ro("finished", [](const League& self) { return self.tasks().finished(); })
      .def_prop_ro("errands", [](const League& self) { return self.tasks().errands_done(); })
      .def_prop_ro("pose", &pose, nb::rv_policy::automatic)
      .def_prop_ro(
          "letters",
          [](const League& self) {
            const std::size_t robots = self.pose().size();
            return own(std::vector<std::uint8_t>(self.letters()), {self.letters().size() / robots, robots});
          },
          nb::rv_policy::automatic)
      .def_prop_ro("unexecuted", &unexecuted, nb::rv_policy::automatic)
      .def_prop_ro("events", &events, nb::rv_policy::automatic)
      .def_prop_ro("tasks", &tasks, nb::rv_policy::automatic)
      .def_prop_ro("delays", &delays, nb::rv_policy::automatic)
      .def_prop_ro("segments", &segments, nb::rv_policy::automatic)
      .def_prop_ro("schedule",
                   [](const League& self) {
                     nb::list robots;
                     for (const auto& entries : self.tasks().schedule()) {
                       nb::list own;
                       for (const auto& [time, task] : entries) own.append(nb::make_tuple(time, task));
                       robots.append(nb::tuple(own));
                     }
                     return robots;
                   })
      .def_prop_ro("errors",
                   [](const League& self) {
                     nb::list found;
                     for (const ActionError& it : self.errors()) {
                       found.append(nb::make_tuple(it.robot, it.other, it.time, it.text));
                     }
                     return found;
                   })
      .def_prop_ro("schedule_errors",
                   [](const League& self) {
                     nb::list found;
                     for (const ScheduleError& it : self.tasks().errors()) {
                       found.append(nb::make_tuple(it.task, it.robot, it.other, it.time, it.text));
                     }
                     return found;
                   })
      .def_prop_ro(
          "call_seconds",
          [](const League& self) {
            return own(std::vector<double>(self.call_seconds()), {self.call_seconds().size()});
          },
          nb::rv_policy::automatic)
      .def_prop_ro("late_calls", &League::late_calls)
      .def_prop_ro("preprocessing_seconds", &League::preprocessing_seconds)
      .def_prop_ro("refused", [](const League& self) {
        const auto* const ticks = dynamic_cast<const Ticks*>(&self);
        return ticks ? ticks->refused() : 0;
      });

  module.def("open", &open, nb::kw_only(), "problem"_a, "planner"_a, "depth"_a, "improve"_a, "threads"_a, "guidance"_a,
             "active"_a.none(), "limit"_a, "iterations"_a.none(), "seed"_a, "preprocessing"_a, "table_mib"_a,
             "period"_a);
}
