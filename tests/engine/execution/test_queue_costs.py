"""What assigners are told of errands with several places, against every choice of a place for each."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mrpbench_assigners_greedy.insertion import Insertion
from mrpbench_tests.execution.task_steps import TaskSteps
from mrpbench_tests.instances.problems import grid_of, problem_on

from mrpbench_core.builtin.task_sources.listed import ListedStream
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.model.planning.scenario import Task
from mrpbench_core.testing.fixtures.room import fleet

mapf = pytest.importorskip("mrpbench_planners_mapf.pibt")
ROADMAP = grid_of([".....", ".#.#.", "....."])


class Curious(Insertion):
    """Notes the first problem that it is given."""

    def assign_queues(self, problem):
        asked.append(problem)
        return super().assign_queues(problem)


asked = []


def task(index, sets):
    vertices = [vertex for places in sets for vertex in places]
    goals = np.column_stack([ROADMAP.position[vertices], np.full(len(vertices), np.nan)])
    errand = np.repeat(np.arange(len(sets)), [len(places) for places in sets])
    return Task(goals=goals, errand=errand, levels=np.zeros(len(goals), np.int16), index=index)


SETS = st.lists(st.lists(st.integers(0, 12), min_size=1, max_size=3, unique=True), min_size=1, max_size=3)


@settings(max_examples=25, deadline=None)
@given(st.lists(SETS, min_size=1, max_size=3), st.sampled_from(["roadmap", "euclidean"]))
def test_the_costs_of_a_task_are_those_of_its_best_places(tasks, cost):
    asked.clear()
    stream = ListedStream([task(index, sets) for index, sets in enumerate(tasks)])
    run = TaskSteps(problem_on(ROADMAP, [0, 12], [0, 12]), stream, Curious(cost=cost), mapf.Pibt())
    run.step()
    problem, costs = asked[0], QueueCosts(cost, ROADMAP, fleet(2))

    def along(way):
        return float(costs.along(0, tuple((vertex,) for vertex in way))[0, 0])

    for column, sets in enumerate(tasks):
        for robot, start in enumerate((0, 12)):
            best = min(along((start, *way)) for way in product(*sets))
            assert problem.approach[robot, column] + problem.length[robot, column] == pytest.approx(best)
        for row, before in enumerate(tasks):
            least = min(along(way) for way in product(before[-1], sets[0]))
            assert problem.between[0, row, column] == pytest.approx(least)
