"""Builds the problem that a planner is given, from an instance and an assignment."""

import attrs
import numpy as np

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.checking.scenario import check_reach, check_scenario, check_travel
from mrpbench_core.engine.stage import RunEnded
from mrpbench_core.engine.stages.costs import cost_matrix
from mrpbench_core.engine.stages.prepare import RunInstance, summary
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.problem import Feature, Goals, Problem, features_of
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.runs.status import RunStatus, Stage


def build_problem(instance: RunInstance, assigned: tuple[int, ...] | None, assigner: Assigner) -> Problem:
    """The problem for the planner; `assigned` is the task that `assigner` gave each robot, None: the planner chooses.

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
    goals = tuple(tuple((vertex,) for vertex in instance.goals[task]) if task >= 0 else anywhere for task in assigned)
    problem = problem_with_features(instance.roadmap, instance.fleet, instance.start, goals)
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
    profile = np.array(fleet.profiles[1], np.int32)
    problem = Problem(
        roadmap=roadmap,
        profile=profile,
        radius=fleet.radii,
        start=start,
        ready=np.zeros(len(fleet), "i8"),
        goals=goals,
    )
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
        InputError: a task is a sequence of goals, or there are fewer tasks than robots.
    """
    robots, tasks = len(instance.fleet), len(instance.goals)
    if any(len(sequence) != 1 for sequence in instance.goals):
        raise InputError("planner: with `assign` every task must have one goal, and one here has several")
    if tasks < robots:
        raise InputError(f"planner: with `assign` there must be a task for every robot; {tasks} for {robots} robots")
    known = tuple(sorted({sequence[0] for sequence in instance.goals} - {-1}))
    if len(known) < robots:
        raise RunEnded(
            RunStatus.SCENARIO_INFEASIBLE,
            Stage.SCENARIO,
            f"{len(known)} different goals on the roadmap for {robots} robots",
        )
    return ((known,),) * robots
