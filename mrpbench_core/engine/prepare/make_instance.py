"""Makes the instance of a run: world, fleet, roadmap and scenario, the assignment, and the first problem."""

from typing import Any

import attrs

from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.api.world import WorldSource
from mrpbench_core.checking.context import check_instance
from mrpbench_core.checking.doorways import check_doorways
from mrpbench_core.config.identity import options_text
from mrpbench_core.config.settings import FleetEntry
from mrpbench_core.engine.contract_checks import check_drawn, check_made, check_returned, check_size
from mrpbench_core.engine.prepare.assign import assign
from mrpbench_core.engine.prepare.fleet import build_fleet
from mrpbench_core.engine.prepare.problem_building import build_problem, standing_problem
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.prepare.run_instance import RunInstance, summary
from mrpbench_core.engine.stage import Announce, RunEnded
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.model.worlds.world import World

Site = tuple[World, Fleet, Roadmap]
_SITES: list[tuple[tuple[WorldSource, RoadmapBuilder, tuple[FleetEntry, ...], int], Site]] = []
"""The worlds, fleets and roadmaps that this process made last, by what they were made of."""
_KEPT = 4


def make_instance(question: Question, announce: Announce, timing: dict[str, Any]) -> Instance:
    """Return the instance of a run.

    Raises:
        InputError: the settings do not fit the world, the robots or the scenario.
        RunEnded: no planner can solve the scenario, or the tasks cannot be assigned.
    """
    run_instance = build_run_instance(question, announce)
    try:
        if question.executes:
            _require_free_doorways(run_instance)
        if question.tasks is not None:
            assigned: tuple[int, ...] | None = (-1,) * len(run_instance.fleet)
            problem = standing_problem(run_instance)
        else:
            assigned = None if question.planner_assigns else assign(question.assigner, run_instance, announce, timing)
            problem = build_problem(run_instance, assigned, question.assigner, question.goal_sets)
    except RunEnded as ended:
        ended.scenario_id = run_instance.scenario.id
        raise
    return Instance(
        world=run_instance.world,
        fleet=run_instance.fleet,
        scenario=run_instance.scenario,
        problem=problem,
        assigned=assigned,
    )


def build_run_instance(question: Question, announce: Announce) -> RunInstance:
    """Load the world, build fleet and roadmap, and draw the scenario.

    Raises:
        InputError: the settings do not fit the world, the robots or the scenario.
    """
    world, fleet, roadmap = _site(question, announce)
    announce(Stage.SCENARIO, {})
    drawn = question.scenario.draw(world, roadmap, fleet, question.seed)
    scenario = check_drawn(check_returned(question.scenario, drawn, Scenario), len(fleet))
    check_made("the scenario", check_instance(world, scenario=scenario))
    if question.tasks is not None:
        scenario = attrs.evolve(scenario, tasks=(), stream=f"{options_text(question.tasks)} {question.seed}")
    if any(task.release > 0 for task in scenario.tasks) or len(scenario.tasks) > len(fleet):
        raise InputError("scenario: tasks released over time, or more tasks than robots, cannot be executed yet")
    return RunInstance(world=world, fleet=fleet, roadmap=roadmap, scenario=scenario)


def _site(question: Question, announce: Announce) -> Site:
    """World, fleet and roadmap; the last ones are kept, since runs of a study mostly have them in common."""
    size = check_size(question.scenario.size())
    key = question.world, question.roadmap, question.fleet, size
    for known, site in _SITES:
        if known == key:
            return site
    announce(Stage.WORLD, {})
    world = check_returned(question.world, question.world.load(), World)
    check_made("the world", check_instance(world))
    fleet = build_fleet(question.fleet, size)
    announce(Stage.ROADMAP, {})
    roadmap = check_returned(question.roadmap, question.roadmap.build(world, fleet), Roadmap)
    check_made("the roadmap", check_instance(world, roadmap))
    if not question.world.reads():  # the content of these files may change
        _SITES[:] = [*_SITES[1 - _KEPT :], (key, (world, fleet, roadmap))]
    return world, fleet, roadmap


def _require_free_doorways(instance: RunInstance) -> None:
    """Require that no robot starts where a door swings.

    Raises:
        RunEnded: a robot starts where a door swings.
    """
    radii, names = instance.fleet.radii, instance.scenario.start_names
    if faults := check_doorways(instance.world, instance.roadmap, instance.start, radii, names):
        raise RunEnded(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))
