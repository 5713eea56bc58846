"""A world with robots and tasks, before tasks are assigned."""

import attrs
import numpy as np

from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.goals import goal_vertices, start_vertices
from mrpbench_core.model.planning.problem import GoalSet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class RunInstance:
    """The world, robots, roadmap and tasks of a run."""

    world: World
    fleet: Fleet
    roadmap: Roadmap
    scenario: Scenario
    start: np.ndarray = attrs.field(init=False)
    """i4[n] roadmap vertices."""
    goals: list[tuple[GoalSet, ...]] = attrs.field(init=False)
    """The goals of each task; see `goal_vertices`."""

    def __attrs_post_init__(self) -> None:
        object.__setattr__(self, "start", start_vertices(self.roadmap, self.scenario))
        object.__setattr__(self, "goals", goal_vertices(self.roadmap, self.scenario))

    @property
    def task_names(self) -> list[str]:
        """The name of each task, which may be empty."""
        return [task.name for task in self.scenario.tasks]


def summary(faults: list[str], shown: int = 3) -> str:
    """The first faults in one line, and how many more there are."""
    more = f"; and {len(faults) - shown} more" if len(faults) > shown else ""
    return "; ".join(faults[:shown]) + more
