"""`mrpbench new-plugin planner NAME --native`: a planner in C++ that is built against the installed mrpbench-native."""

import shutil
from importlib.metadata import files
from pathlib import Path

import pytest

PLANS = """
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Budget
from mrpbench_core.testing.drawing import problem
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_fleet_cpp import FleetCpp

crossing = problem('''
    .  a  .  .
    b  .  .  B
    .  A  .  .
''')
budget = Budget(wall_s=10.0, memory_bytes=1 << 30)
found, best = FleetCpp().plan(crossing, budget), Cbs().plan(crossing, budget)
assert not check_plan(crossing, found.plan).faults + check_plan(crossing, found.plan).conflicts
assert found.plan.sum_of_costs == best.plan.sum_of_costs, (found.plan.sum_of_costs, best.plan.sum_of_costs)
try:
    FleetCpp(orders=0)
except ValueError:
    pass
else:
    raise AssertionError("the range of an option in C++ is not that of the component")
"""


def test_the_distribution_of_native_holds_headers_libraries_and_a_cmake_package():
    held = {str(file) for file in files("mrpbench-native") or ()}
    assert {
        "mrpbench_native/cmake/mrpbench_native-config.cmake",
        "mrpbench_native/include/mrpbench_bindings/mapf_solvers.hpp",
        "mrpbench_native/include/mrpbench_mapf/common/limits.hpp",
        "mrpbench_native/include/mrpbench_mapf/infeasibility/solvability.hpp",
        "mrpbench_native/include/mrpbench_mapf/model/instance.hpp",
        "mrpbench_native/include/mrpbench_mapf/single_agent/distance_table.hpp",
        "mrpbench_native/include/mrpbench_options/options.hpp",
        "mrpbench_native/lib/libmrpbench_mapf.a",
        "mrpbench_native/lib/libmrpbench_options.a",
    } <= held


def test_headers_of_the_libraries_do_not_use_python():
    native = Path(__file__).parents[2] / "native/include"
    texts = {path: path.read_text() for path in native.rglob("*.hpp")}
    assert not [path for path, text in texts.items() if "Python.h" in text or "nanobind" in text]


@pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler")
@pytest.mark.timeout(600)
def test_a_new_planner_in_cpp_is_built_checked_and_plans(mrpbench, environment, tmp_path, monkeypatch):
    code, out, err = mrpbench("new-plugin", "planner", "fleet_cpp", "--native", "--folder", "cpp")
    assert code == 0, err
    assert "  pip install cpp\n" in out
    monkeypatch.setenv("SKBUILD_CMAKE_BUILD_TYPE", "Debug")  # compiles in a third of the time
    words = ["--quiet", "--no-deps", "--no-build-isolation", "./cpp"]
    environment("pip", "install", *words, cwd=tmp_path, timeout=500)
    assert " 0 failed" in environment("mrpbench", "check", "planner:fleet_cpp", cwd=tmp_path).stdout
    environment("python", "-c", PLANS, cwd=tmp_path)


def test_only_planners_can_be_native(mrpbench):
    assert mrpbench("new-plugin", "metric", "mine", "--native") == (
        2,
        "",
        "--native is for planners, not for a metric\n",
    )
