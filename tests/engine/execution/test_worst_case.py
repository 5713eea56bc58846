"""The adversary finds the worst way to spread its ticks over moves, and strikes once, whoever executes the plan."""

from itertools import combinations_with_replacement

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from mrpbench_tests.instances.random_plans import random_plan, random_plan_with_resources

from mrpbench_core.api import DispatchError
from mrpbench_core.builtin.dispatchers.adg import Adg
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.execution.worst_case import Adversary, lateness
from mrpbench_core.engine.run import execute
from mrpbench_core.files.errors import InputErrors
from mrpbench_core.model.planning.dependencies import Dependencies
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording


class Naive:
    """Executes a plan move by move until no time changes any more."""

    def __init__(self, problem, plan):
        self.graph = Dependencies(problem, plan)
        self.moves = moves = self.graph.moves
        self.ticks = [int(problem.duration(r)[e]) for r, e in zip(moves.robot, moves.edge, strict=True)]
        self.tick, place = problem.roadmap.tick, problem.roadmap.position
        length = [np.hypot(*(place[h] - place[t])) for h, t in zip(moves.head, moves.tail, strict=True)]
        reach = problem.radius[moves.robot] + problem.radius.max()
        self.share = np.minimum(1, reach / np.maximum(length, 1e-9))
        self.needs = [self.graph.of(move) for move in range(len(moves.robot))]

    def total(self, delays):
        """The sum of the times at which robots arrive, if each move begins `delays[move]` seconds later than it may."""
        moves, begin = self.moves, np.array(delays, float)
        duration = np.array(self.ticks) * self.tick
        for _ in range(2 * len(begin) + 2):
            before = begin.copy()
            for move in range(len(begin)):
                ready = [0.0]
                if move > moves.first[moves.robot[move]]:
                    ready.append(begin[move - 1] + duration[move - 1])
                for robot, segments, reached in self.needs[move]:
                    own = range(moves.first[robot], moves.first[robot + 1])
                    passed = [other for other in own if moves.segment[other] < segments]
                    if passed:
                        ready.append(
                            begin[passed[-1]] + duration[passed[-1]] * (1 if reached else self.share[passed[-1]])
                        )
                begin[move] = max(ready) + delays[move]
            if np.array_equal(before, begin):
                break
        ends = [moves.first[robot + 1] - 1 for robot in set(moves.robot.tolist())]
        return sum(begin[end] + duration[end] for end in ends)


def without_rotations(problem, plan):
    """Whether each move begins by itself, in an order that `adg` keeps."""
    try:
        Adg().start(problem, plan)
    except DispatchError:
        return False
    graph = Dependencies(problem, plan)
    return not any(graph.rotates(move) for move in range(len(graph.moves.robot)))


@settings(deadline=None, max_examples=12, suppress_health_check=[HealthCheck.filter_too_much])
@given(st.integers(0, 2**32 - 1), st.booleans(), st.integers(1, 3))
def test_no_way_to_spread_the_ticks_over_moves_is_worse(seed, resources, k):
    problem, plan = (random_plan_with_resources if resources else random_plan)(np.random.default_rng(seed))
    naive = Naive(problem, plan)
    count = len(naive.moves.robot)
    assume(0 < count <= (40, 14, 9)[k - 1])
    assume(without_rotations(problem, plan))
    tick = problem.roadmap.tick
    punctual = naive.total(np.zeros(count))
    late = lateness(problem, plan, k * tick)
    worst = 0.0
    for chosen in combinations_with_replacement(range(count), k):
        delays = np.bincount(chosen, minlength=count) * tick
        lost = naive.total(delays) - punctual
        worst = max(worst, lost)
        if len(set(chosen)) == 1:
            assert late[chosen[0]] == pytest.approx(lost, abs=1e-6)
    assert late.max() == pytest.approx(worst, abs=1e-6)


def test_without_moves_there_is_no_attack():
    problem, plan = random_plan(np.random.default_rng(1))
    nothing = type(plan)(paths=tuple(type(path)(edge=[], enter=[], leave=[]) for path in plan.paths))
    adversary = Adversary(problem, nothing, 3.0)
    still = np.zeros(len(problem), int)
    assert adversary.update(0.0, still, still) == ()
    assert not adversary.stopped.any()


def run(tmp_path, name, **changes):
    """The record of robots in the office, and when which robot is delayed for how long."""
    study = {"world": "office", "scenario": {"plugin": "random", "robots": 3}, "planner": "prioritized"}
    study |= {"fleet": [{"robot": "turtlebot3_burger", "lidar": "none"}], "limits": {"execution": 600}}
    study |= {"assigner": "identity", "control_rate": 5, "metrics": ["delay", "execution"]} | changes
    (point,) = load_study(study).runs
    paths = RunPaths(recording=tmp_path / f"{name}.zip", exports=tmp_path / "exports")
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None)
    assert record.status == "succeeded", record.error
    columns = [
        Recording(paths.recording).channel(f"event_{key}").tolist() for key in ("kind", "time", "robot", "detail")
    ]
    return record, [row[1:] for row in zip(*columns, strict=True) if row[0] == "delay"]


def test_every_execution_of_a_plan_meets_the_same_attack_once(tmp_path):
    pytest.importorskip("mrpbench_planners_mapf")
    attack, found = {"delays": {"worst_case": 20}}, []
    for name, changes in {
        "adg": {"execution": "schedule_only"},
        "btpg": {"execution": "schedule_only", "dispatcher": "btpg"},
        "planar": {"simulator": "planar"},
    }.items():
        record, delays = run(tmp_path, name, **attack, **changes)
        assert [detail for *_, detail in delays] == ["20 s"]
        found.append(delays[0][1])
        if name == "adg":
            punctual, _ = run(tmp_path, "punctual", **changes)
            late = record.metrics["execution.duration_s"] - punctual.metrics["execution.duration_s"]
            assert late <= 20.4
    assert len(set(found)) == 1


def test_tasks_over_time_have_no_plan_that_could_be_attacked():
    study = {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "prioritized"}
    with pytest.raises(InputErrors, match=r"delays\.worst_case: an adversary needs the plan"):
        load_study(study | {"tasks": {"plugin": "poisson", "rate": 12, "service": 1}, "delays": {"worst_case": 3}})
