"""Plans of a policy on roadmaps on which turns and moves take time, judged by the validator."""

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_policies.planner import PolicyPlanner

from mrpbench_core.api import Budget, Feature, PlanStatus, check_plan
from mrpbench_core.builtin.roadmaps.headings import with_headings
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.planning.problem import features_of
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.testing.drawing import grid, problem

AMPLE = Budget(wall_s=30.0, memory_bytes=1 << 30)
TURTLEBOT = load_robot("turtlebot3_burger")


def headed(roadmap, ticks=7):
    """A roadmap with headings, whose moves take so many ticks."""
    slow = attrs.evolve(roadmap, tick=0.5, duration=np.full_like(roadmap.duration, ticks))
    return with_headings(slow, [TURTLEBOT])


def asked(roadmap, start, goals, **fields):
    """The problem of robots on a roadmap with headings."""
    flat = problem("a A", roadmap=roadmap, start=np.array(start, "i4"), goals=goals, profile=np.zeros(len(start), "i4"))
    fields = {"radius": np.full(len(start), 0.3), "ready": np.zeros(len(start), "i8"), **fields}
    made = attrs.evolve(flat, **fields)
    return attrs.evolve(made, features=features_of(made) | {Feature.FOOTPRINTS})


@pytest.fixture(scope="module")
def planner(greedy):
    return PolicyPlanner(file=greedy, observation="cost_to_go", radius=2, shield="pibt", steps=60)


def test_a_robot_turns_moves_and_stops(planner):
    roadmap = headed(grid(2, 2))
    wanted = asked(roadmap, [int(roadmap.facing(np.array([0], "i4"), np.array([0.0]))[0])], (((3,),),))
    result = planner.plan(wanted, AMPLE)
    assert check_plan(wanted, result.plan).valid
    edges = wanted.roadmap.edges[result.plan.paths[0].edge]
    place = roadmap.grid.cell[edges]
    moves = (place[:, 0] != place[:, 1]).any(axis=1)
    assert moves.sum() == 2  # to the upper right
    assert edges[-1, 1] == 3  # at rest
    assert len(edges) == (4 if moves[0] else 5)


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 2**32), st.sampled_from([1, 7]), st.booleans())
def test_plans_with_turns_are_valid(planner, seed, ticks, window):
    """Many robots in a small room, with goals in turn, until all are there or for a window."""
    generator = np.random.default_rng(seed)
    rows, columns = generator.integers(2, 5, 2).tolist()
    roadmap = headed(grid(rows, columns), ticks)
    robots = int(generator.integers(1, rows * columns))
    cells = rows * columns
    yaw = generator.choice([0, 0.5, 1, 1.5], robots) * np.pi
    start = roadmap.facing(generator.permutation(cells)[:robots].astype("i4"), yaw)
    last = generator.permutation(cells)[:robots].tolist()
    goals = tuple(((int(generator.integers(cells)),), (goal,)) for goal in last)
    wanted = asked(roadmap, start, goals, horizon=8 * ticks if window else None)
    assert planner.skip(wanted) is None
    result = planner.plan(wanted, AMPLE)
    if result.plan is None:  # a policy may never get there
        assert result.status is PlanStatus.GAVE_UP
        assert not window
        return
    assert check_plan(wanted, result.plan).valid, check_plan(wanted, result.plan)


def test_robots_with_footprints_keep_a_cell_apart_without_headings(planner):
    wanted = problem("b a . B A", radius=0.3, features={Feature.FOOTPRINTS})
    result = planner.plan(wanted, AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert check_plan(wanted, result.plan).valid
    assert result.plan.makespan == 4  # the second one waits for the first move of the first one


@pytest.mark.parametrize("tasks", [False, True])
def test_policies_drive_bodies_by_plans_with_turns(planner, tmp_path, tasks):
    study = {
        "name": "turns",
        "world": {"plugin": "generated_random", "columns": 7, "rows": 6, "blocked": 0.1},
        "roadmap": {"plugin": "grid", "duration_model": "kinodynamic"},
        "scenario": {"plugin": "random", "robots": 3},
        "fleet": {"robot": "turtlebot3_burger", "lidar": "none"},
        "planner": {"plugin": "policy", "file": str(planner.file), "observation": "cost_to_go", "shield": "pibt"},
        "assigner": "identity",
        "simulator": "kinematic",
        "delays": {"p_delay": 0.02},
    }
    if tasks:
        study |= {"tasks": "closed_pool", "assigner": "greedy", "limits": {"execution": "1 min"}}
        study |= {"planner": {"plugin": "rolling_horizon", "planner": study["planner"]}, "metrics": ["tasks"]}
        study |= {"replanning": {"period": "10 s", "window": "30 s"}}
    run = load_study(study).runs[0]
    record = execute(run.config, "run", RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports"))
    assert record.status == "succeeded"
    if tasks:
        assert record.metrics["tasks.done"] >= 2
