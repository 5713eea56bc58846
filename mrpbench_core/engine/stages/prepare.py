"""Builds the instance of a run: world, fleet, roadmap and scenario."""

import attrs
import numpy as np

from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.api.world import WorldSource
from mrpbench_core.checking.context import check_instance
from mrpbench_core.checking.doorways import check_doorways
from mrpbench_core.config.identity import options_text
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.engine.contract_checks import check_copied, check_drawn, check_made, check_size
from mrpbench_core.engine.own import Handed, difference
from mrpbench_core.engine.stage import Announce, RunEnded
from mrpbench_core.engine.stages.fleet import build_fleet, robot_model
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.problem import GoalSet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.model.runs.status import RunStatus, Stage
from mrpbench_core.model.worlds.world import World
from mrpbench_core.plugins.contract import is_of
from mrpbench_core.plugins.provenance import components_in

_WORLD: list[tuple[WorldSource, World]] = []
"""The world that `prepare` loaded and its source, or nothing."""
_LAST: list[tuple[RoadmapBuilder, World, Fleet, Roadmap]] = []
"""The roadmap that this process built last and what it was built from, or nothing."""


@attrs.frozen(kw_only=True)
class RunInstance:
    """The world, robots, roadmap and tasks of a run."""

    world: World
    fleet: Fleet
    roadmap: Roadmap
    scenario: Scenario
    start: np.ndarray
    """i4[n] roadmap vertices."""
    goals: list[tuple[GoalSet, ...]]
    """The goals of each task; see `goal_vertices`."""

    @property
    def task_names(self) -> list[str]:
        """The name of each task, which may be empty."""
        return [task.name for task in self.scenario.tasks]


def build_run_instance(config: RunConfig, announce: Announce) -> RunInstance:
    """Load the world, build fleet and roadmap, and draw the scenario.

    Raises:
        InputError: the configuration does not fit the world, the robots or the scenario.
        RunEnded: the scenario cannot be solved by any planner.
    """
    announce(Stage.WORLD, {})
    world = _world(config.world)
    fleet = build_fleet(config, check_size(config.scenario.size()))
    announce(Stage.ROADMAP, {})
    roadmap = _roadmap(config.roadmap, world, fleet)
    announce(Stage.SCENARIO, {})
    handed = Handed((world, roadmap, fleet), "world, roadmap or fleet")
    drawn = check_copied(config.scenario, config.scenario.draw(*handed.given, config.seed), Scenario)
    scenario = check_drawn(drawn, len(fleet))
    handed.check(config.scenario)
    check_made("the scenario", check_instance(world, scenario=scenario))
    if config.tasks is not None:
        scenario = attrs.evolve(scenario, tasks=(), stream=f"{options_text(config.tasks)} {config.seed}")
    if any(task.release > 0 for task in scenario.tasks) or len(scenario.tasks) > len(fleet):
        raise InputError("scenario: tasks released over time, or more tasks than robots, cannot be executed yet")
    return RunInstance(
        world=world,
        fleet=fleet,
        roadmap=roadmap,
        scenario=scenario,
        start=start_vertices(roadmap, scenario),
        goals=goal_vertices(roadmap, scenario),
    )


def prepare(config: RunConfig) -> None:
    """Load the world and build the roadmap of a run, for it and for others that have these objects in common.

    Nothing is done where this would call a component that is no part of the core.
    """
    for entry in config.fleet:
        robot_model(entry)
    components = components_in((config.world, config.roadmap, config.scenario))
    if all(is_of(type(component)) for component in components):
        world = _world(config.world)
        _roadmap(config.roadmap, world, build_fleet(config, check_size(config.scenario.size())))
        if not config.world.reads():  # the content of these files may change
            _WORLD[:] = [(config.world, world)]


def _world(source: WorldSource) -> World:
    """Load the world, or take the one that was prepared."""
    if _WORLD and _WORLD[0][0] is source:
        return _WORLD[0][1]
    world = check_copied(source, source.load(), World)
    check_made("the world", check_instance(world))
    return world


def _roadmap(builder: RoadmapBuilder, world: World, fleet: Fleet) -> Roadmap:
    """Build the roadmap, or take that of the last run in this process if it was built from the same."""
    if _LAST and _LAST[0][0] == builder and difference((world, fleet), _LAST[0][1:3], "") is None:
        return _LAST[0][3]
    given = Handed((world, fleet), "world or fleet")
    roadmap = check_copied(builder, builder.build(*given.given), Roadmap)
    given.check(builder)
    check_made("the roadmap", check_instance(world, roadmap))
    _LAST[:] = [(builder, world, fleet, roadmap)]
    return roadmap


def require_free_doorways(instance: RunInstance) -> None:
    """Require that no robot starts where a door swings.

    Raises:
        RunEnded: a robot starts where a door swings.
    """
    radii, names = instance.fleet.radii, instance.scenario.start_names
    if faults := check_doorways(instance.world, instance.roadmap, instance.start, radii, names):
        raise RunEnded(RunStatus.SCENARIO_INFEASIBLE, Stage.SCENARIO, summary(faults))


def summary(faults: list[str], shown: int = 3) -> str:
    """The first faults in one line, and how many more there are."""
    more = f"; and {len(faults) - shown} more" if len(faults) > shown else ""
    return "; ".join(faults[:shown]) + more


def start_vertices(roadmap: Roadmap, scenario: Scenario) -> Int32:
    """The roadmap vertices i4[n] at which robots start; -1 = not on the roadmap. Robots with any yaw start with 0."""
    vertex = roadmap.locate(scenario.start[:, :2], scenario.start_level)
    return roadmap.facing(vertex, np.nan_to_num(scenario.start[:, 2]))


def goal_vertices(roadmap: Roadmap, scenario: Scenario) -> list[tuple[GoalSet, ...]]:
    """The roadmap vertices of each task's errands, in order; (-1,) = no place is on the roadmap."""
    return [tuple(tuple(goal) or (-1,) for goal in goal_yaws(roadmap, task)) for task in scenario.tasks]


def goal_yaws(roadmap: Roadmap, task: Task) -> tuple[dict[int, float], ...]:
    """For each errand of a task the radians wanted at each vertex that will do, NaN = any."""
    vertices = roadmap.facing(roadmap.locate(task.goals[:, :2], task.levels), task.goals[:, 2]).tolist()
    places = task.by_errand([*zip(vertices, task.goals[:, 2].tolist(), strict=True)])
    return tuple({vertex: yaw for vertex, yaw in errand if vertex >= 0} for errand in places)
