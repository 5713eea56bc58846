"""Planners that assign, on the public instances of joint assignment and path finding."""

import csv
import time
from collections.abc import Iterator
from pathlib import Path as File
from typing import NamedTuple

import pytest
import yaml
from mrpbench_planners_mapf.cbs_ta import CbsTa, ItaCbs
from mrpbench_planners_mapf.ecbs_ta import EcbsTa, ItaEcbs
from mrpbench_tests.instances.problems import problem_on
from mrpbench_tests.instances.roadmaps import grid_of
from mrpbench_tests.oracles.judge import AMPLE, ask

from mrpbench_core.model.planning.plan import Budget, PlanStatus
from mrpbench_core.model.planning.problem import Problem

SLACK_S = 5.0
"""Far more than the planners need; other work may share the machine."""
DIFFERENT_COSTS = {("8x8_obst12", 8, 0, "g5"), ("8x8_obst12", 8, 1, "g5")}
"""Their published optima, 50 and 26, count waiting at a goal as free even if the robot leaves it again. By arrival
times the optima are 54 and 27."""


class Row(NamedTuple):
    """One instance: agents 5j to 5j+4 share their goals (`g5`), or all do (`anon`)."""

    set: str
    agents: int
    ex: int
    goal_mode: str

    def load(self, data: File) -> Problem:
        size, _, obstacles = self.set.partition("_obst")
        side = size.partition("x")[0]
        name = f"map_{side}by{side}_obst{obstacles}_agents{self.agents}_ex{self.ex}.yaml"
        drawn = yaml.safe_load((data / "mapf_ta" / name).read_text())
        width, height = drawn["map"]["dimensions"]
        blocked = {tuple(cell) for cell in drawn["map"]["obstacles"]}
        road = grid_of(["".join("#" if (x, y) in blocked else "." for x in range(width)) for y in range(height)])
        index = {(int(x), int(-y)): vertex for vertex, (x, y) in enumerate(road.position)}
        starts = [index[tuple(agent["start"])] for agent in drawn["agents"]]
        goals = [index[tuple(agent["goal"])] for agent in drawn["agents"]]
        share = 5 if self.goal_mode == "g5" else self.agents
        groups = [tuple(goals[first : first + share]) for first in range(0, self.agents, share)]
        return problem_on(road, starts, [groups[robot // share] for robot in range(self.agents)])


def optima(data: File) -> Iterator[tuple[Row, int]]:
    """Instances with their least sums of arrival times, as far as they are published."""
    with (data / "mapf_ta_optimal.csv").open() as file:
        for row in csv.DictReader(file):
            one = Row(row["set"], int(row["agents"]), int(row["ex"]), row["goal_mode"])
            if one not in DIFFERENT_COSTS:
                yield one, int(row["optimal_soc"])


def test_limits_hold_while_there_are_ever_more_assignments(shared_data):
    asked = Row("32x32_obst204", 50, 1, "anon").load(shared_data)
    began = time.monotonic()
    assert CbsTa().plan(asked, Budget(wall_s=0.1, memory_bytes=1 << 30)).status is PlanStatus.TIMEOUT
    assert time.monotonic() - began < 0.1 + SLACK_S
    assert CbsTa().plan(asked, Budget(wall_s=20, memory_bytes=8 << 20)).status is PlanStatus.OUT_OF_MEMORY


@pytest.mark.parametrize("kind", [ItaCbs, EcbsTa, ItaEcbs])
def test_published_optima(kind, shared_data):
    budget = Budget(wall_s=0.3, memory_bytes=1 << 30)
    solved = 0
    rows = list(optima(shared_data))
    for row, optimum in rows:
        solved += ask(kind(), row.load(shared_data), optimum, budget).status is PlanStatus.SOLVED
    assert solved > 0.8 * len(rows)


def test_published_optima_by_ranked_assignments(shared_data):
    rows = [(row, optimum) for row, optimum in optima(shared_data) if row.agents <= 20]
    for row, optimum in rows:
        assert ask(CbsTa(), row.load(shared_data), optimum, AMPLE).status is PlanStatus.SOLVED
