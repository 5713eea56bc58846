"""What an instance is made of: the part of a configuration that no judged component belongs to."""

from typing import Any, Self

import attrs

from mrpbench_core.api.assigner import Assigner
from mrpbench_core.api.planner import Planner
from mrpbench_core.api.roadmap import RoadmapBuilder
from mrpbench_core.api.scenario import ScenarioSource
from mrpbench_core.api.task_source import TaskSource
from mrpbench_core.api.world import WorldSource
from mrpbench_core.config.settings import FleetEntry, RunConfig
from mrpbench_core.model.planning.problem import Feature

SETTINGS = ("world", "roadmap", "scenario", "tasks", "fleet", "assigner", "seed")
"""Of `RunConfig`."""


@attrs.frozen(kw_only=True)
class Question:
    """The settings and facts from which an instance is made."""

    world: WorldSource
    roadmap: RoadmapBuilder
    scenario: ScenarioSource
    tasks: TaskSource | None
    fleet: tuple[FleetEntry, ...]
    assigner: Assigner
    seed: int
    executes: bool
    """The plan is executed."""
    planner_assigns: bool
    goal_sets: bool
    """The planner takes sets of goals."""

    @classmethod
    def of(cls, config: RunConfig) -> Self:
        """The part of a configuration."""
        return cls(
            **{name: getattr(config, name) for name in SETTINGS}, **facts_of(config.planner), executes=config.executes
        )


def facts_of(planner: Planner) -> dict[str, Any]:
    """What an instance depends on of its planner, as plain data."""
    return {"planner_assigns": bool(planner.assigns), "goal_sets": Feature.GOAL_SETS in planner.supports}
