"""The public instances of joint assignment and path finding, as YAML files of libMultiRobotPlanning."""

import csv
from collections.abc import Iterator
from pathlib import Path as File
from typing import NamedTuple

import yaml
from mapf_instances import grid, problem

from mrpbench_core.model.problem import Problem

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
        road = grid(["".join("#" if (x, y) in blocked else "." for x in range(width)) for y in range(height)])
        index = {(int(x), int(-y)): vertex for vertex, (x, y) in enumerate(road.position)}
        starts = [index[tuple(agent["start"])] for agent in drawn["agents"]]
        goals = [index[tuple(agent["goal"])] for agent in drawn["agents"]]
        share = 5 if self.goal_mode == "g5" else self.agents
        groups = [tuple(goals[first : first + share]) for first in range(0, self.agents, share)]
        return problem(road, starts, [groups[robot // share] for robot in range(self.agents)])


def optima(data: File) -> Iterator[tuple[Row, int]]:
    """Instances with their least sums of arrival times, as far as they are published."""
    with (data / "mapf_ta_optimal.csv").open() as file:
        for row in csv.DictReader(file):
            one = Row(row["set"], int(row["agents"]), int(row["ex"]), row["goal_mode"])
            if one not in DIFFERENT_COSTS:
                yield one, int(row["optimal_soc"])
