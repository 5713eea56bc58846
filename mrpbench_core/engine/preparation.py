"""Everything before planning: world, roadmap, fleet, scenario, assignment, problem."""

import time
from collections.abc import Callable
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api.assigner import Assigner, AssignmentError
from mrpbench_core.checking.assignment import check_assignment
from mrpbench_core.checking.doorways import check_doorways
from mrpbench_core.checking.scenario import check_reach, check_scenario, check_travel
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.answers import check_drawn
from mrpbench_core.engine.costs import cost_matrix
from mrpbench_core.engine.fleet import build_fleet
from mrpbench_core.engine.problem import build_problem, goal_vertices
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.assignment import AssignmentProblem
from mrpbench_core.model.fleet import Fleet
from mrpbench_core.model.plan import Plan
from mrpbench_core.model.problem import GoalSet, Problem
from mrpbench_core.model.roadmap import Roadmap
from mrpbench_core.model.scenario import Scenario
from mrpbench_core.model.status import RunStatus, Stage
from mrpbench_core.model.world import World

Announce = Callable[[Stage, dict[str, Any]], None]
"""Told the name of each stage before it begins, with facts about the run so far."""


class Ended(Exception):  # noqa: N818 - it is no error
    """The run is over before its last stage, with a definite status."""

    def __init__(self, status: RunStatus, stage: Stage, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.stage = stage


@attrs.frozen(kw_only=True)
class Setting:
    """Where a run takes place and what is to be done."""

    world: World
    fleet: Fleet
    roadmap: Roadmap
    scenario: Scenario
    start: np.ndarray
    """i4[n] roadmap vertices."""
    goals: list[tuple[int, ...]]
    """Roadmap vertices of each task."""


def set_scene(config: RunConfig, announce: Announce) -> Setting:
    """Load, build and draw.

    Raises:
        InputError: something the user wrote does not fit.
        Ended: the scenario cannot be solved by any planner.
    """
    announce(Stage.WORLD, {})
    world = config.world.load()
    fleet = build_fleet(config, config.scenario.size())
    announce(Stage.ROADMAP, {})
    roadmap = config.roadmap.build(world, fleet)
    announce(Stage.SCENARIO, {})
    scenario = check_drawn(config.scenario.draw(world, roadmap, fleet, config.seed), len(fleet))
    if any(task.release > 0 for task in scenario.tasks) or len(scenario.tasks) > len(fleet):
        raise InputError("scenario: tasks released over time, or more tasks than robots, cannot be executed yet")
    start = roadmap.locate(scenario.start[:, :2], scenario.start_level)
    return Setting(
        world=world,
        fleet=fleet,
        roadmap=roadmap,
        scenario=scenario,
        start=start,
        goals=goal_vertices(roadmap, scenario),
    )


def assign(config: RunConfig, setting: Setting, announce: Announce, timing: dict[str, Any]) -> tuple[int, ...]:
    """The task of each robot, -1 = none.

    Raises:
        Ended: no assignment was found, or the assigner returned a wrong one.
    """
    announce(Stage.ASSIGNMENT, {"scenario_id": setting.scenario.id})
    assigner = config.assigner
    began = time.perf_counter()
    if assigner.reads_costs:
        costs = cost_matrix(assigner.cost, setting.roadmap, setting.fleet, setting.scenario)
        if faults := check_travel(costs, setting.scenario.start_names, _task_names(setting)):
            raise Ended(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
    else:
        costs = np.zeros((len(setting.fleet), len(setting.scenario.tasks)))
    timing["cost_matrix_s"] = time.perf_counter() - began
    question = AssignmentProblem(costs=costs, tasks=setting.scenario.tasks)
    began = time.perf_counter()
    try:
        assignment = assigner.assign(question)
    except AssignmentError as error:
        raise Ended(RunStatus.ASSIGNMENT_FAILED, Stage.ASSIGNMENT, str(error)) from error
    timing["assignment_s"] = time.perf_counter() - began
    if faults := check_assignment(question, assignment):
        raise Ended(RunStatus.ASSIGNMENT_FAILED, Stage.ASSIGNMENT, f"{type(assigner).__name__} {faults[0]}")
    return tuple(int(task) for task in assignment.task)


def pose_problem(setting: Setting, assigned: tuple[int, ...] | None, assigner: Assigner) -> Problem:
    """The problem for the planner; `assigned` is the task that `assigner` gave each robot, None: the planner chooses.

    Raises:
        InputError: the planner cannot choose among these tasks.
        Ended: robots stand on one another, or a goal is blocked, shared or unreachable.
    """
    if assigned is None:
        problem = build_problem(setting.roadmap, setting.fleet, setting.start, candidates(setting))
        if faults := check_scenario(problem, setting.scenario.start_names):
            raise Ended(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
        return problem
    anywhere = (tuple(range(len(setting.roadmap.position))),)  # for a robot without a task, which may have to make way
    goals = tuple(tuple((vertex,) for vertex in setting.goals[task]) if task >= 0 else anywhere for task in assigned)
    problem = build_problem(setting.roadmap, setting.fleet, setting.start, goals)
    names = _task_names(setting)
    goal_names = [names[task] if task >= 0 else "" for task in assigned]
    if faults := check_scenario(problem, setting.scenario.start_names, goal_names):
        lost = check_reach(problem, setting.scenario.start_names, goal_names)
        if faults == lost and assigner.reads_costs and assigner.cost != "roadmap" and _could_be_assigned(setting):
            raise Ended(
                RunStatus.ASSIGNMENT_FAILED,
                Stage.ASSIGNMENT,
                f"{summary(lost)}: {assigner.cost} costs know nothing of ways; cost: roadmap does",
            )
        raise Ended(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
    return problem


def keep_off_doors(setting: Setting) -> None:
    """Make sure that doors can move from the start.

    Raises:
        Ended: a robot stands in the way of one.
    """
    radii, names = setting.fleet.radii, setting.scenario.start_names
    if faults := check_doorways(setting.world, setting.roadmap, setting.start, radii, names):
        raise Ended(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))


def _could_be_assigned(setting: Setting) -> bool:
    """Tell whether every robot, or every task, could have one that can be reached."""
    return not check_travel(cost_matrix("roadmap", setting.roadmap, setting.fleet, setting.scenario))


def candidates(setting: Setting) -> tuple[tuple[GoalSet, ...], ...]:
    """For every robot the goals of all tasks, of which it may take any that no other takes.

    Raises:
        InputError: a task is a sequence of goals, or there are fewer tasks than robots.
    """
    robots, tasks = len(setting.fleet), len(setting.goals)
    if any(len(sequence) != 1 for sequence in setting.goals):
        raise InputError("planner: with `assign` every task must have one goal, and one here has several")
    if tasks < robots:
        raise InputError(f"planner: with `assign` there must be a task for every robot; {tasks} for {robots} robots")
    known = tuple(sorted({sequence[0] for sequence in setting.goals} - {-1}))
    if len(known) < robots:
        raise Ended(
            RunStatus.SCENARIO_INFEASIBLE,
            Stage.SCENARIO,
            f"{len(known)} different goals on the roadmap for {robots} robots",
        )
    return ((known,),) * robots


def taken(setting: Setting, problem: Problem, plan: Plan) -> tuple[int, ...]:
    """The task of each robot when the planner has chosen: the one whose goal is where its path ends."""
    task = {sequence[0]: index for index, sequence in reversed(list(enumerate(setting.goals)))}
    starts = problem.start.tolist()
    return tuple(task[path.end(problem.roadmap, start)] for path, start in zip(plan.paths, starts, strict=True))


def summary(faults: list[str], shown: int = 3) -> str:
    """The first faults in one line, and how many more there are."""
    more = f"; and {len(faults) - shown} more" if len(faults) > shown else ""
    return "; ".join(faults[:shown]) + more


def _task_names(setting: Setting) -> list[str]:
    return [task.name for task in setting.scenario.tasks]
