"""Commands doors and lifts for the robots to which they are assigned.

A robot may use a resource (`FleetView.granted`) once the door is open (closed where the robot only drives past), or
once the cabin is at the robot's level with open doors.
"""

from collections.abc import Mapping

import attrs
import numpy as np

from mrpbench_core.engine.execution.resources import ExecutionError, Resources
from mrpbench_core.model.common.arrays import Bool, Int32
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.plan import Plan
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.world import Lift, World


class FacilityManager(Resources):
    """The doors, lifts and mutexes of one execution with physics."""

    def __init__(self, world: World, problem: Problem, plan: Plan) -> None:
        super().__init__(problem)
        self.facilities = Facilities(world)
        self._lifts = {lift.name: lift for lift in world.lifts}
        self._entrances = {lift.name: [g for g in self.facilities.doors if g.lift is lift] for lift in world.lifts}
        self._level = problem.roadmap.level
        self.adopt(problem, plan)

    def adopt(self, problem: Problem, plan: Plan) -> None:
        """Go on with a new plan."""
        self._problem, self._plan = problem, plan
        self._shown: dict[tuple[int, str], tuple[Bool, Bool, Bool]] = {}

    def with_grants(self, view: FleetView, state: State) -> FleetView:
        """The view of a dispatcher, completed by the resources that robots may use now."""
        if not self._held:
            return view
        self.ready = tuple(
            (robot, name)
            for name, holders in self._held.items()
            for robot in holders
            if self._is_ready(robot, name, int(view.reached[robot]), state.facilities)
        )
        return attrs.evolve(view, granted=self.ready) if self.ready else view

    def states(self, state: State) -> list[float]:
        """Positions of doors and lifts, in the order of `Facilities.names`; [] if the simulator has no facilities."""
        return [state.facilities.get(name, np.nan) for name in self.facilities.names] if state.facilities else []

    def commands(self, reached: Int32, released: Int32, state: State) -> dict[str, float]:
        """Commands for doors and lifts, see `Inputs.facilities`.

        Raises:
            ExecutionError: a robot needs a door or lift, and the simulator supports neither.
        """
        if not self._resources or not self.facilities.names:
            return {}
        if not state.facilities:
            if any(holders and self._resources[name].kind != "mutex" for name, holders in self._held.items()):
                raise ExecutionError("the simulator supports neither doors nor lifts: use kinematic or planar")
            return {}
        commands: dict[str, float] = {}
        for name, resource in self._resources.items():
            holders = self._held[name]
            if resource.kind == "door":
                commands[name] = float(any(self._passes(robot, name, int(reached[robot])) for robot in holders))
            elif resource.kind == "lift":
                stop = None
                if holders:
                    robot = holders[0]
                    stop = self._stop(robot, name, int(reached[robot]), int(released[robot]))
                commands |= self._lift_commands(self._lifts[name], stop, state.facilities)
        return commands

    def _is_ready(self, robot: int, name: str, reached: int, state: Mapping[str, float]) -> bool:
        """Tell whether a robot may use a resource that it holds."""
        kind = self._resources[name].kind
        if kind == "door" and name in state:
            return state[name] == float(self._passes(robot, name, reached))
        if kind == "lift" and name in state:
            lift, level = self._lifts[name], self._stop(robot, name, reached, reached)
            here = self.facilities.is_at(lift, level, state)
            return here and all(state[gate.name] == 1 for gate in self._entrances[name] if level in gate.opens_on)
        return kind == "mutex"

    def _stop(self, robot: int, name: str, reached: int, released: int) -> int:
        """Return the level at which a robot enters a lift, or leaves it once the ride is released.

        A robot may hold a lift ahead of its use, while it is still on a level that the lift does not serve.
        """
        inside, _, _ = self._uses(robot, name)
        ahead = np.flatnonzero(inside[reached:])
        first = reached + (int(ahead[0]) if len(ahead) else 0)
        vertices = self._plan.paths[robot].vertices(self._problem.roadmap, int(self._problem.start[robot]))
        levels = self._level[vertices[first : first + 2]]
        return int(levels[-1] if first < released and first == reached else levels[0])

    def _lift_commands(self, lift: Lift, stop: int | None, state: Mapping[str, float]) -> dict[str, float]:
        """Close the doors, go to the level `stop`, open them; without a `stop`, close them."""
        gates = self._entrances[lift.name]
        if stop is not None and self.facilities.is_at(lift, stop, state):
            return {gate.name: float(stop in gate.opens_on) for gate in gates}
        commands = dict.fromkeys((gate.name for gate in gates), 0.0)
        if stop is not None and all(state[gate.name] == 0 for gate in gates):
            commands[lift.name] = self.facilities.heights[lift.name][stop]
        return commands

    def _passes(self, robot: int, name: str, reached: int) -> bool:
        """Tell whether the robot's use of a door, the one under way or else the next, leads through the doorway."""
        inside, passing, joined = self._uses(robot, name)
        ahead = np.flatnonzero(inside[reached:])
        if not len(ahead):
            return False
        first = reached + int(ahead[0])
        last = first + 1
        while first > 0 and inside[first - 1] and joined[first]:
            first -= 1
        while last < len(inside) and inside[last] and joined[last]:
            last += 1
        return bool(passing[first:last].any())

    def _uses(self, robot: int, name: str) -> tuple[Bool, Bool, Bool]:
        """For each segment of a robot's path, whether it is in a door's resource, and whether in its doorway; and for
        each vertex, whether it is in the resource. A use ends at a vertex outside of the resource.
        """
        if (robot, name) not in self._shown:
            resource, path = self._resources[name], self._plan.paths[robot]
            edge, vertex = path.edge, path.vertices(self._problem.roadmap, int(self._problem.start[robot]))
            waits = (edge < 0) & np.isin(vertex[1:], resource.vertices)
            inside = np.isin(edge, resource.edges) | waits
            self._shown[robot, name] = inside, np.isin(edge, resource.passage), np.isin(vertex, resource.vertices)
        return self._shown[robot, name]
