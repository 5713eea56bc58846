"""What a run is about: made before planning, apart from the components that are judged."""

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.goals import goal_vertices, goal_yaws
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.planning.scenario import Scenario
from mrpbench_core.model.runs.routing import PlanFilter, Router, speed_limits
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Instance:
    """The world, robots, roadmap and tasks of a run, and the first problem of its planner."""

    world: World
    fleet: Fleet
    scenario: Scenario
    problem: Problem
    """On the roadmap, from the starts to the goals of the assigned tasks."""
    assigned: tuple[int, ...] | None
    """Task of each robot, -1 = none; None: the planner chooses."""

    @property
    def roadmap(self) -> Roadmap:
        """The roadmap of the problem."""
        return self.problem.roadmap

    def tasks_of(self, plan: Plan | None) -> tuple[int, ...]:
        """The task of each robot: as assigned or, where the planner chooses, the one whose goal ends its path."""
        if self.assigned is not None:
            return self.assigned
        if plan is None:
            return (-1,) * len(self.problem)
        goals = goal_vertices(self.roadmap, self.scenario)
        task = {vertex: index for index, ((vertex,),) in reversed(list(enumerate(goals)))}
        starts = self.problem.start.tolist()
        ends = (path.end(self.roadmap, start) for path, start in zip(plan.paths, starts, strict=True))
        return tuple(task[end] for end in ends)

    def router(self, assigned: tuple[int, ...], plan_filter: PlanFilter) -> Router:
        """Return what turns plans of the problem into routes, for robots with these tasks."""
        yaw: Float = np.full(len(assigned), np.nan)
        for robot, task in enumerate(assigned):
            if task >= 0:
                yaws = goal_yaws(self.roadmap, self.scenario.tasks[task])[-1]
                goal = self.problem.goals[robot][-1]  # a planner that assigns has the goals of all tasks here
                yaw[robot] = next(yaws[vertex] for vertex in goal if vertex in yaws)  # of several, all are equal
        return Router(self.problem, yaw, speed_limits(self.world, self.roadmap), plan_filter)
