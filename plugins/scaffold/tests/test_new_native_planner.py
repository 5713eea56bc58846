"""`mrpbench new-plugin planner NAME --native`: a planner in C++ that is built against the installed mrpbench-native."""

import re
import shutil
from importlib.metadata import files
from pathlib import Path

import pytest

HOW_TO = Path(__file__).parents[3] / "docs/how-to"
HEADERS = re.compile(r"`(mrpbench_mapf/[\w/]+\.hpp)`")
PLANS = """
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Budget
from mrpbench_core.testing.drawing import problem
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_acme import Acme

crossing = problem('''
    .  a  .  .
    b  .  .  B
    .  A  .  .
''')
budget = Budget(wall_s=10.0, memory_bytes=1 << 30)
found, best = Acme().plan(crossing, budget), Cbs().plan(crossing, budget)
assert check_plan(crossing, found.plan).valid
assert found.plan.sum_of_costs == best.plan.sum_of_costs, (found.plan.sum_of_costs, best.plan.sum_of_costs)
try:
    Acme(orders=0)
except ValueError:
    pass
else:
    raise AssertionError("the range of an option in C++ is not that of the component")
"""


@pytest.fixture(scope="module")
def page():
    return (HOW_TO / "planner-native.md").read_text()


def blocks(page, language):
    """The blocks of code in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


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
    native = Path(__file__).parents[3] / "native/include"
    texts = {path: path.read_text() for path in native.rglob("*.hpp")}
    assert not [path for path, text in texts.items() if "Python.h" in text or "nanobind" in text]


def test_headers_that_the_page_names_exist(page):
    include = Path(__file__).parents[3] / "native/include"
    named = HEADERS.findall(page)
    assert len(named) > 8
    assert not [header for header in named if not (include / header).is_file()]


@pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler")
def test_the_page_leads_to_a_planner_in_cpp_in_a_report(page, environment, tmp_path, monkeypatch):
    monkeypatch.setenv("SKBUILD_CMAKE_BUILD_TYPE", "Debug")  # compiles in a third of the time
    monkeypatch.setenv("PIP_NO_DEPS", "1")  # they are here, in the version of this checkout
    monkeypatch.setenv("PIP_NO_BUILD_ISOLATION", "0")  # pip reads this as: no isolation
    first, study = blocks(page, "sh")
    environment("sh", "-ec", first, cwd=tmp_path, timeout=500)
    folder = tmp_path / "mrpbench-planners-acme"
    written = {str(path.relative_to(folder)) for path in folder.rglob("*")}
    assert set(re.findall(r"^\| `(\w+/[\w/.]+)`", page, re.MULTILINE)) - written <= set(HEADERS.findall(page))
    (excerpt,) = blocks(page, "cpp")
    assert excerpt in (folder / "src/acme.cpp").read_text()
    environment("python", "-c", PLANS, cwd=tmp_path)
    (folder / "acme.yaml").write_text(blocks(page, "yaml")[0])
    done = environment("sh", "-ec", study, cwd=folder, timeout=500).stdout
    assert len(re.findall(r"\bacme\b", done)) > 1
    assert (folder / "results/acme/report.html").is_file()
    environment("pip", "uninstall", "--quiet", "--yes", "mrpbench-planners-acme", cwd=tmp_path)


def test_only_planners_can_be_native(mrpbench):
    assert mrpbench("new-plugin", "metric", "mine", "--native") == (
        2,
        "",
        "--native is for planners, not for a metric\n",
    )
