"""A small set of plugins of every kind, so that these tests depend on no other part of the project."""

import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.files.errors import InputErrors

CODE = """
from mrpbench_core.api import *
import enum
from pathlib import Path
from typing import ClassVar, Literal
import attrs
from attrs import validators

def fill(cls):
    "Make a class concrete: configuration never calls the methods."
    for name in cls.__abstractmethods__:
        setattr(cls, name, lambda self, *a, **k: None)
    cls.__abstractmethods__ = frozenset()
    return cls

class Critic(Component):
    group: ClassVar[str] = "mrpbench.critics"

class Speed(enum.StrEnum):
    SLOW = "slow"
    FAST = "fast"

@fill
@attrs.frozen(kw_only=True)
class Office(WorldSource): pass

@fill
@attrs.frozen(kw_only=True)
class Rmf(WorldSource):
    file: Path = option(help="the map")
    extra: Path | None = option(None, help="another file")

@fill
@attrs.frozen(kw_only=True)
class Lanes(RoadmapBuilder):
    cell_size: float = option(0.4, help="side of a cell", unit="m", validator=validators.gt(0))

@fill
@attrs.frozen(kw_only=True)
class Random(ScenarioSource):
    robots: int = option(help="number of robots", validator=validators.ge(1))

@fill
@attrs.frozen(kw_only=True)
class Hungarian(Assigner):
    objective: Literal["sum", "bottleneck"] = option("sum", help="what is minimised")

@fill
@attrs.frozen(kw_only=True)
class Astar(Planner): pass

@fill
@attrs.frozen(kw_only=True)
class Ecbs(Planner):
    w: float = option(1.2, help="bound", validator=validators.ge(1), infinite=True)
    heuristic: Literal["zero", "cg"] = option("cg", help="high-level heuristic")
    iterations: int | None = option(None, help="nodes", validator=validators.optional(validators.ge(1)))
    speed: Speed = option(Speed.SLOW, help="how fast")
    weights: tuple[float, ...] = option((1.0, 2.0), help="weights")
    pair: tuple[int, str] = option((1, "a"), help="a pair")
    tags: frozenset[str] = option(frozenset(), help="tags")
    level: str | None = option(None, help="level", former="floor")
    flag: bool = option(False, help="flag")
    either: float | Literal["auto"] = option("auto", help="a number or auto")

@fill
@attrs.frozen(kw_only=True)
class TaskAssigning(Planner):
    supports: ClassVar = frozenset({Feature.GOAL_SETS})
    assign: bool = option(False, help="choose goals too")

@fill
@attrs.frozen(kw_only=True)
class Adg(Dispatcher): pass

@fill
@attrs.frozen(kw_only=True)
class Waypoints(Navigator): pass

@fill
@attrs.frozen(kw_only=True)
class Pursuit(Controller): pass

@fill
@attrs.frozen(kw_only=True)
class PathDistance(Critic):
    scale: float = option(32.0, help="weight")

@fill
@attrs.frozen(kw_only=True)
class Obstacle(Critic):
    scale: float = option(0.02, help="weight")

@fill
@attrs.frozen(kw_only=True)
class Dwb(Controller):
    max_speed: float = option(0.26, help="top speed", unit="m/s", validator=validators.gt(0))
    min_speed: float = option(0.0, help="lowest speed", unit="m/s")
    period: float = option(1 / 20, help="period", unit="s")
    critics: tuple[Critic, ...] = option((PathDistance(),), help="critics")
    best: Critic | None = option(None, help="one more critic")

    @min_speed.validator
    def _check(self, field, value):
        if value > self.max_speed:
            raise ValueError("min_speed exceeds max_speed")

@fill
@attrs.frozen(kw_only=True)
class Kinematic(Simulator):
    timestep: float = option(1 / 240, help="step", unit="s", validator=validators.gt(0))

    def __attrs_post_init__(self):
        if self.timestep == 13:
            raise ValueError("13 is unlucky")

@fill
@attrs.frozen(kw_only=True)
class Truth(Localizer): pass

@fill
@attrs.frozen(kw_only=True)
class Planning(Metric):
    columns: ClassVar = ()

@fill
@attrs.frozen(kw_only=True)
class Execution(Metric):
    columns: ClassVar = ()
    bins: int = option(10, help="bins")

@fill
@attrs.frozen(kw_only=True)
class Rosbag(WritableFormat):
    storage: Literal["mcap", "sqlite3"] = option("mcap", help="format")
"""

NAMES = {
    "mrpbench.worlds": {"office": "Office", "rmf": "Rmf"},
    "mrpbench.roadmaps": {"lanes": "Lanes"},
    "mrpbench.scenarios": {"random": "Random"},
    "mrpbench.assigners": {"hungarian": "Hungarian"},
    "mrpbench.planners": {"astar": "Astar", "ecbs": "Ecbs", "task_assigning": "TaskAssigning"},
    "mrpbench.dispatchers": {"adg": "Adg"},
    "mrpbench.navigators": {"waypoints": "Waypoints"},
    "mrpbench.controllers": {"pure_pursuit": "Pursuit", "dwb": "Dwb"},
    "mrpbench.critics": {"path_dist": "PathDistance", "obstacle": "Obstacle"},
    "mrpbench.simulators": {"kinematic": "Kinematic"},
    "mrpbench.localizers": {"ground_truth": "Truth"},
    "mrpbench.metrics": {"planning": "Planning", "execution": "Execution"},
    "mrpbench.formats": {"rosbag2": "Rosbag"},
}


@pytest.fixture
def toy(install):
    """Installs the plugins above, and nothing else."""
    groups = {group: {name: f"{{module}}:{cls}" for name, cls in entries.items()} for group, entries in NAMES.items()}
    install("toy", groups, CODE)


@pytest.fixture
def study(toy, tmp_path):
    """Return a function that loads a text as the configuration `some.yaml`."""

    def load(text, *overrides):
        path = tmp_path / "some.yaml"
        path.write_text(text)
        return load_study(path, overrides)

    return load


@pytest.fixture
def errors(study, tmp_path):
    """Return a function that gives the lines of a text's errors, less the folder's name."""

    def load(text, *overrides):
        with pytest.raises(InputErrors) as caught:
            study(text, *overrides)
        return str(caught.value).replace(f"{tmp_path}/", "").splitlines()

    return load
