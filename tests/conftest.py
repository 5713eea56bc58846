"""Small worlds and runs that tests of several packages share."""

import importlib
import sys
import textwrap
from importlib import metadata

import numpy as np
import pytest

from mrpbench_core.model.common.fleet import Fleet, Lidar, RobotModel
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.planning.plan import Path, Plan, PlanResult, PlanStatus
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Raster, Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.world import Level, Vertex, World
from mrpbench_core.plugins import installed

collect_ignore = ["data"]


@pytest.fixture
def robot_model() -> RobotModel:
    square = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]
    return RobotModel(name="square", footprint=square, max_speed=0.5, max_turn_rate=2.0, lidar=Lidar(beams=36))


@pytest.fixture
def corridor() -> Roadmap:
    """Three cells of 1 m in a row, two-way."""
    return Roadmap(
        position=[[0.5, 0.5], [1.5, 0.5], [2.5, 0.5]],
        level=[0, 0, 0],
        heading=[np.nan] * 3,
        edges=[[0, 1], [1, 0], [1, 2], [2, 1]],
        duration=[[1, 1, 1, 1]],
        tick=2.0,
        grid=Raster(shape=(1, 3), cell_size=1.0, origin=(0.0, 0.0), cell=[[0, 0], [0, 1], [0, 2]]),
        place=[0, 2],
    )


@pytest.fixture
def run_context(corridor, robot_model) -> RunContext:
    """Two robots in the corridor, one behind the other, each moving one cell."""
    problem = Problem(
        roadmap=corridor,
        profile=[0, 0],
        radius=[0.15, 0.15],
        start=[0, 1],
        ready=[0, 0],
        goals=(((1,),), ((2,),)),
    )
    plan = Plan(paths=(Path(edge=[-1, 0], enter=[0, 1], leave=[1, 2]), Path(edge=[2], enter=[0], leave=[1])))
    walls = [[0, 0, 3, 0], [3, 0, 3, 1], [3, 1, 0, 1], [0, 1, 0, 0]]
    return RunContext(
        run_id="0123456789abcdef",
        world=World(
            name="corridor",
            levels=(Level(name="L1", walls=walls),),
            vertices=(Vertex(name="west", x=0.5, y=0.5), Vertex(name="east", x=2.5, y=0.5)),
        ),
        fleet=Fleet(robots=(robot_model, robot_model)),
        scenario=Scenario(
            start=[[0.5, 0.5, np.nan], [1.5, 0.5, np.nan]],
            start_level=[0, 0],
            tasks=(Task(goals=[[1.5, 0.5, np.nan]]), Task(goals=[[2.5, 0.5, np.nan]])),
        ),
        problem=problem,
        result=PlanResult(status=PlanStatus.SOLVED, plan=plan, lower_bound=3.0, statistics={"expansions": 7.0}),
        routes=(
            Route(waypoint=[[0.5, 0.5, np.nan]] * 2 + [[1.5, 0.5, np.nan]], level=[0, 0, 0], speed=[np.inf, np.inf]),
            Route(waypoint=[[1.5, 0.5, np.nan], [2.5, 0.5, np.nan]], level=[0, 0], speed=[np.inf]),
        ),
        goal=((1.5, 0.5, float("nan")), (2.5, 0.5, float("nan"))),
    )


@pytest.fixture
def new_plan():
    """Return a function that gives the rows of a new plan that takes effect at `time`, with the paths of the first."""

    def rows(time):
        return {
            "route_time": np.full(5, float(time)),
            "route_revision": np.ones(5, "i4"),
            "route_robot": np.array([0, 0, 0, 1, 1], "i4"),
            "route_waypoint": np.array([[0.5, 0.5, 0], [0.5, 0.5, 0], [1.5, 0.5, 0], [1.5, 0.5, 0], [2.5, 0.5, 0]]),
            "route_level": np.zeros(5, "i2"),
            "route_speed": np.ones(5),
            "route_edge": np.array([-1, -1, 0, -1, 2], "i4"),
            "route_leave": np.array([0, 1, 2, 0, 1]),
        }

    return rows


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Return a function that writes a throw-away distribution, as pip would leave it; while it lasts, only those exist.

    `install(name, {group: {name: value}}, code)`; `{module}` in a value is the distribution's one module.
    """
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(str(site))
    made = set()

    def entries():
        return [entry for name in made for entry in metadata.distribution(name).entry_points]

    def make(name, groups, code="", version="1.0", requires=(), files=None):
        module = name.replace("-", "_")
        (site / f"{module}.py").write_text(textwrap.dedent(code))
        folder = site / f"{module}-{version}.dist-info"
        folder.mkdir()
        lines = ["Metadata-Version: 2.1", f"Name: {name}", f"Version: {version}"]
        lines += [f"Requires-Dist: {requirement}" for requirement in requires]
        (folder / "METADATA").write_text("\n".join(lines) + "\n")
        text = ""
        for group, names in groups.items():
            text += f"[{group}]\n" + "".join(f"{key} = {value}\n" for key, value in names.items())
        (folder / "entry_points.txt").write_text(text.replace("{module}", module))
        for file, content in (files or {}).items():
            (folder / file).write_text(content)
        made.add(name)
        importlib.invalidate_caches()
        installed.refresh()
        return site / f"{module}.py"

    monkeypatch.setattr(installed, "entry_points", entries)
    installed.refresh()
    yield make
    for name in made:
        sys.modules.pop(name.replace("-", "_"), None)
    monkeypatch.undo()
    installed.refresh()
