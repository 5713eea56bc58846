"""Builds the problem that a planner is given, from an instance and an assignment."""

from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.checking.scenario import check_reach, check_scenario, check_travel
from mrpbench_core.engine.execution.destinations import Errand, Places
from mrpbench_core.engine.execution.queue_costs import QueueCosts
from mrpbench_core.engine.prepare.costs import cost_matrix
from mrpbench_core.engine.prepare.run_instance import RunInstance, summary
from mrpbench_core.engine.stage import RunEnded
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.goals import first_problem, goal_yaws
from mrpbench_core.model.planning.problem import Feature, Goals, Problem, features_of
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.runs.status import RunStatus, Stage


def build_problem(
    instance: RunInstance, assigned: tuple[int, ...] | None, assigner: Assigner, sets: bool = True
) -> Problem:
    """The problem for the planner; `assigned` is the task that `assigner` gave each robot, None: the planner chooses.

    Of errands with several places, one is chosen here unless the planner takes `sets` of goals.

    Raises:
        InputError: the planner cannot choose among these tasks.
        RunEnded: two robots overlap at their starts, or a goal is blocked, shared or unreachable.
    """
    if assigned is None:
        problem = problem_with_features(instance.roadmap, instance.fleet, instance.start, candidate_goals(instance))
        if faults := check_scenario(problem, instance.scenario.start_names):
            raise RunEnded(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
        return problem
    anywhere = (tuple(range(len(instance.roadmap.position))),)  # for a robot without a task, which may have to make way
    goals = tuple(instance.goals[task] if task >= 0 else anywhere for task in assigned)
    problem = problem_with_features(instance.roadmap, instance.fleet, instance.start, goals)
    if any(len(goal) > 1 for task in assigned if task >= 0 for goal in instance.goals[task]):
        problem = problem_with_features(
            instance.roadmap, instance.fleet, instance.start, _chosen(instance, problem, assigned, sets)
        )
    names = instance.task_names
    goal_names = [names[task] if task >= 0 else "" for task in assigned]
    if faults := check_scenario(problem, instance.scenario.start_names, goal_names):
        lost = check_reach(problem, instance.scenario.start_names, goal_names)
        if faults == lost and assigner.reads_costs and assigner.cost != "roadmap" and _can_be_assigned(instance):
            raise RunEnded(
                RunStatus.ASSIGNMENT_FAILED,
                Stage.ASSIGNMENT,
                f"{summary(lost)}: {assigner.cost} costs know nothing of ways; cost: roadmap does",
            )
        raise RunEnded(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
    return problem


def _chosen(instance: RunInstance, problem: Problem, assigned: tuple[int, ...], sets: bool) -> Goals:
    """The goals of a problem such that all robots can stand at theirs at once, where there are such.

    Robots with one place for their last errand come first, then those with several, in their order.
    """
    costs = QueueCosts("roadmap", instance.roadmap, instance.fleet)
    goals = list(problem.goals)
    ways: list[Sequence[Errand]] = []
    for robot, task in enumerate(assigned):
        if task >= 0 and all(goal != (-1,) for goal in goals[robot]) and instance.start[robot] >= 0:
            yaws = goal_yaws(instance.roadmap, instance.scenario.tasks[task])
            errands = [Errand(robot, task, number, places) for number, places in enumerate(yaws)]
            ways.append(costs.nearest_first(errands, int(instance.start[robot])))
    ways.sort(key=lambda way: len(way[-1].yaws) > 1)
    places = Places(problem, costs.labels, "stay", sets)
    made = places.destinations(ways, instance.start.astype(np.int64))
    for way in ways:
        robot = way[0].robot
        if len(made.errands[robot]) == len(way):
            goals[robot] = made.goals[robot]
        else:  # there is no room
            goals[robot] = tuple(tuple(errand.yaws)[:1] for errand in way)
    return tuple(goals)


def standing_problem(instance: RunInstance) -> Problem:
    """The first problem where tasks come over time: every robot is where it should be.

    Raises:
        RunEnded: two robots overlap at their starts.
    """
    goals = tuple(((vertex,),) for vertex in instance.start.tolist())
    problem = problem_with_features(instance.roadmap, instance.fleet, instance.start, goals)
    if faults := check_scenario(problem, instance.scenario.start_names):
        raise RunEnded(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
    return problem


def problem_with_features(roadmap: Roadmap, fleet: Fleet, start: np.ndarray, goals: Goals) -> Problem:
    """The problem of driving `fleet` from vertices `start` i4[n] to `goals`, with the features it needs.

    Footprints matter where discs of the fleet's radii do not fit on the roadmap side by side: on every roadmap that is
    no raster, on one with several vertices at a place, and on a raster whose cells are smaller than the two largest
    robots. On a wider raster the field's usual point-like conflicts suffice, since a dispatcher admits no robot to a
    cell before the last one has cleared it.
    """
    problem = first_problem(roadmap, fleet, start, goals)
    wide = 2 * float(np.sort(fleet.radii)[-2:].mean())
    features = features_of(problem)
    crowded = Feature.HEADINGS in features or roadmap.grid is None or wide > roadmap.grid.cell_size + 1e-9
    features |= {Feature.FOOTPRINTS} if crowded else set()
    return attrs.evolve(problem, features=features)


def _can_be_assigned(instance: RunInstance) -> bool:
    """Tell whether every robot, or every task, could have one that can be reached."""
    return not check_travel(cost_matrix("roadmap", instance.roadmap, instance.fleet, instance.scenario))


def candidate_goals(instance: RunInstance) -> Goals:
    """For every robot the goals of all tasks, of which it may take any that no other takes.

    Raises:
        InputError: a task has several errands, or several places for one, or there are fewer tasks than robots.
    """
    robots, tasks = len(instance.fleet), len(instance.goals)
    if any([*map(len, sequence)] != [1] for sequence in instance.goals):
        raise InputError("planner: with `assign` every task must have one goal, and one here has several")
    if tasks < robots:
        raise InputError(f"planner: with `assign` there must be a task for every robot; {tasks} for {robots} robots")
    known = tuple(sorted({vertex for ((vertex,),) in instance.goals} - {-1}))
    if len(known) < robots:
        raise RunEnded(
            RunStatus.SCENARIO_INFEASIBLE,
            Stage.SCENARIO,
            f"{len(known)} different goals on the roadmap for {robots} robots",
        )
    return ((known,),) * robots
