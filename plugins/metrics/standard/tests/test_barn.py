"""The metric `barn` on drives by hand: two metres a sample, from the start to the goal ten metres north."""

from pathlib import Path

import attrs
import numpy as np
import pytest
from mrpbench_metrics_standard import Barn

from mrpbench_core import run
from mrpbench_core.model.worlds.world import Vertex

LENGTH = 12.0
"""metres of the reference path: the optimal time is 6 s."""


@pytest.fixture
def driven(executed):
    """A drive straight north in `duration` seconds, with contacts at some times."""

    def drive(duration, contacts=(), parameters=None):
        time = np.linspace(0, duration, 101)
        track = [[(0.0, 0.1 * step) for step in range(101)]]
        run = executed(time, track, [[0] * 101], [[(0, 0)]], contacts=[(stamp, 0, -1) for stamp in contacts])
        goal = Vertex(name="goal", x=0, y=10, parameters={"barn_path_m": LENGTH} if parameters is None else parameters)
        world = attrs.evolve(run.context.world, vertices=(goal,))
        return attrs.evolve(run, context=attrs.evolve(run.context, world=world))

    return drive


@pytest.mark.parametrize(
    ("duration", "score"), [(10.0, 0.5), (20.0, 6 / 17.8), (60.0, 1 / 8), (100.0, 1 / 8), (115.0, 0.0)]
)
def test_the_score_falls_with_the_time_from_the_first_decimetre_to_a_metre_before_the_goal(driven, duration, score):
    values = Barn().measure(driven(duration))
    assert values["score"] == pytest.approx(score)
    assert values["success"] == (score > 0)
    assert values["time_s"] == (pytest.approx(duration * 0.89) if score else None)


def test_a_contact_before_the_goal_is_a_failure_and_one_after_it_is_none(driven):
    assert Barn().measure(driven(20.0, contacts=[17.9]))["score"] == 0
    assert Barn().measure(driven(20.0, contacts=[18.1]))["success"] == 1


def test_there_is_no_score_without_a_reference_path_and_nothing_in_other_worlds(driven, executed):
    values = Barn().measure(driven(20.0, parameters={}))
    assert (values["score"], values["success"]) == (None, 1)
    other = executed([0, 1], [[(0, 0), (1, 0)]], [[0, 0]], [[(0, 0)]])
    assert set(Barn().measure(other).values()) == {None}


@pytest.mark.parametrize("duration", [10.0, 60.0])
def test_a_negative_length_as_in_dynabarn_gives_every_success_an_eighth(driven, duration):
    assert Barn().measure(driven(duration, parameters={"barn_path_m": -20.0}))["score"] == pytest.approx(1 / 8)
    assert Barn().measure(driven(duration, [1.0], parameters={"barn_path_m": -20.0}))["score"] == 0


@pytest.mark.parametrize(("x", "score"), [(5.0, 0.0), (20.0, 1 / 8)])
def test_a_drive_through_a_dynabarn_world_of_our_own_scores_an_eighth_unless_it_touches(tmp_path, x, score):
    (tmp_path / "worlds.csv").write_text("world,class,index\n4,easy,1\n")
    (tmp_path / "frames.csv").write_text(f"class,index,t,x,y\neasy,1,0,{x},-0.5\neasy,1,9,{x},0.5\n")
    tables = {"worlds": str(tmp_path / "worlds.csv"), "keyframes": str(tmp_path / "frames.csv")}
    config = {
        "world": "dynabarn",
        "scenario": "barn",
        "fleet": str(Path(__file__).parents[4] / "benchmarks" / "jackal.yaml"),
        "roadmap": "straight",
        "planner": "astar",
        "dispatcher": "all_at_once",
        "simulator": "planar",
        "crowds": {"plugin": "dynabarn", "index": 4, **tables},
        "limits": {"execution": 100.0},
        "metrics": ["barn", "execution"],
    }
    (record,) = run(config, out=tmp_path / "results")
    assert record["metrics"]["barn.score"] == pytest.approx(score)
    assert record["metrics"]["barn.success"] == (score > 0)
