"""Instances of runs: what runs that agree share, and what they do not."""

import attrs
import pytest
from mrpbench_worlds_standard.shipped import Office

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.prepare.make_instance import build_run_instance
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.stage import ignore

STUDY = {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "example", "simulator": "none"}
STUDY |= {"roadmap": {"plugin": "grid", "cell_size": 1.0}}


def roadmaps(name, values):
    """The roadmaps of two runs that differ in one setting."""
    one, other = load_study(STUDY | {"matrix": {name: values}}).runs
    return [build_run_instance(Question.of(point.config), ignore).roadmap for point in (one, other)]


def test_runs_in_the_same_world_with_the_same_robots_share_a_roadmap():
    one, other = roadmaps("seed", [0, 1])
    assert one is other


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("roadmap.cell_size", [1.0, 1.5]),
        ("fleet", ["turtlebot3_burger", "turtlebot3_waffle"]),
        ("world", ["office", "warehouse"]),
    ],
)
def test_a_roadmap_follows_its_options_the_robots_and_the_world(name, values):
    one, other = roadmaps(name, values)
    again = roadmaps(name, values[::-1])
    for built, rebuilt in ((one, again[1]), (other, again[0])):
        assert (built.position == rebuilt.position).all()
        assert (built.duration == rebuilt.duration).all()
    assert one.position.shape != other.position.shape or (one.duration != other.duration).any()


def instance(config):
    return build_run_instance(Question.of(config), ignore)


def test_the_world_is_loaded_once_for_runs_that_agree(monkeypatch):
    config = load_study(STUDY | {"roadmap": {"plugin": "grid", "cell_size": 0.9}}).runs[0].config
    loads = []
    monkeypatch.setattr(Office, "load", lambda world, load=Office.load: loads.append(world) or load(world))
    drawn = {instance(attrs.evolve(config, seed=seed)).scenario.id for seed in (0, 1, 0)}
    assert len(loads) == 1
    assert len(drawn) == 2


def test_a_world_that_reads_files_of_which_the_configuration_knows_nothing_is_read_for_each_run(monkeypatch, tmp_path):
    monkeypatch.setattr(Office, "reads", lambda _: (tmp_path / "walls.pgm",))
    (point,) = load_study(STUDY | {"roadmap": {"plugin": "grid", "cell_size": 1.1}}).runs
    assert instance(point.config).world is not instance(point.config).world


MAKERS = """
import attrs
import numpy as np

from mrpbench_core.api import option
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_worlds_standard.shipped import Office


@attrs.frozen(kw_only=True)
class BadWorld(Office):
    how: str = option(help="what is wrong")

    def load(self):
        world = super().load()
        level = world.levels[0]
        return attrs.evolve(world, **{
            "walls": {"levels": (attrs.evolve(level, walls=np.full((1, 4), np.nan)),)},
            "levels": {"levels": ()},
            "lanes": {"lanes": (attrs.evolve(world.lanes[0], end=999),)},
            "places": {"vertices": tuple(attrs.evolve(vertex, x=float("nan")) for vertex in world.vertices)},
        }[self.how])


@attrs.frozen(kw_only=True)
class BadRoadmap(GridRoadmap):
    how: str = option(help="what is wrong")

    def build(self, world, fleet):
        roadmap = super().build(world, fleet)
        return attrs.evolve(roadmap, **{
            "edges": {"edges": roadmap.edges + 10**6},
            "duration": {"duration": 0 * roadmap.duration},
            "forbidden": {"duration": -5 + 0 * roadmap.duration},
            "tick": {"tick": float("nan")},
            "position": {"position": np.full_like(roadmap.position, np.nan)},
            "rows": {"duration": np.zeros((0, 3), np.int32)},
        }[self.how])


@attrs.frozen(kw_only=True)
class BadScenario(Random):
    how: str = option(help="what is wrong")

    def size(self):
        return {"size": "two", "less": -1}.get(self.how, 2)

    def draw(self, world, roadmap, fleet, seed):
        scenario = super().draw(world, roadmap, fleet, seed)
        if self.how == "yaw":
            return attrs.evolve(scenario, start=np.column_stack([scenario.start[:, :2], [np.nan, np.inf]]))
        return attrs.evolve(scenario, start_level=scenario.start_level + 9)
"""


@pytest.mark.parametrize(
    ("kind", "how", "fault"),
    [
        ("World", "walls", "the world returned what cannot be: walls is not finite"),
        ("World", "levels", "the world returned what cannot be: world has no level"),
        ("World", "lanes", "the world returned what cannot be: a lane: its end does not exist"),
        ("World", "places", "the world returned what cannot be: x is nan"),
        ("Roadmap", "edges", "the roadmap returned what cannot be: roadmap.edges does not exist"),
        ("Roadmap", "duration", "the roadmap returned what cannot be: roadmap.duration has moves that take no time"),
        ("Roadmap", "forbidden", "roadmap.duration has moves that take no time"),
        ("Roadmap", "tick", "the roadmap returned what cannot be: tick is nan"),
        ("Roadmap", "position", "the roadmap returned what cannot be: roadmap.position is not finite"),
        ("Roadmap", "rows", "roadmap.duration has another number of edges than roadmap.edges"),
        ("Scenario", "size", "the scenario returned 'two' instead of a number of robots"),
        ("Scenario", "less", "the scenario returned -1 instead of a number of robots"),
        ("Scenario", "yaw", "the scenario returned a start that is nowhere"),
        ("Scenario", "level", "the scenario returned what cannot be: scenario.start_level does not exist"),
    ],
)
def test_what_cannot_be_is_refused_where_it_is_made(tmp_path, monkeypatch, kind, how, fault):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bad.py").write_text(MAKERS)
    robots = {"robots": 2} if kind == "Scenario" else {}
    (point,) = load_study(STUDY | {kind.lower(): {"plugin": f"./bad.py:Bad{kind}", "how": how, **robots}}).runs
    with pytest.raises(BrokenContractError, match=fault):
        build_run_instance(Question.of(point.config), ignore)
