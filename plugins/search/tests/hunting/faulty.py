"""A planner, a dispatcher and a controller, each with a fault in one rare situation."""

from unittest.mock import patch

import attrs
import numpy as np
from mrpbench_controllers_pure_pursuit import PurePursuit
from mrpbench_planners_example import cooperative_astar

from mrpbench_core.api import Controller, ControllerSession, Planner, Promise
from mrpbench_core.builtin.dispatchers.adg import Adg, AdgSession
from mrpbench_core.model.common.arrays import frozen_array


@attrs.frozen(kw_only=True)
class SwapsAtJunctions(Planner):
    """Plans as `example`, but lets two robots swap on the way from a junction of three ways to its north."""

    promises = frozenset({Promise.CONFLICT_FREE})

    def plan(self, problem, budget):
        roadmap = problem.roadmap
        degree = np.bincount(roadmap.edges[:, 0], minlength=len(roadmap.position))
        north = {
            (tail, head)
            for tail, head in roadmap.edges.tolist()
            if degree[tail] == 3 and degree[head] == 2 and roadmap.position[head, 1] > roadmap.position[tail, 1] + 0.1
        }

        class Reservations(cooperative_astar.Reservations):
            def allow(self, tail, head, tick):
                if (tail, head) in north or (head, tail) in north:
                    return (head, tick) not in self.places and tick < self.parked.get(head, np.inf)
                return super().allow(tail, head, tick)

        with patch.object(cooperative_astar, "Reservations", Reservations):
            return cooperative_astar.Example().plan(problem, budget)


@attrs.frozen(kw_only=True)
class ReleasesEarly(Adg):
    """Releases as `adg`, but lets the second one of two robots that wait for the same robot go at once."""

    def start(self, problem, plan):
        return ReleasesEarlySession(self, problem, plan)


class ReleasesEarlySession(AdgSession):
    def batch(self, executions):
        return None

    def _release(self):
        super()._release()
        waits = [self.graph.blockers(robot) for robot in range(len(self.released))]
        for robot, others in enumerate(waits):
            standing = self.released[robot] == self.counts[0][robot] < len(self.plan.paths[robot])
            rivals = [other for other in range(robot) if len(others) == 1 and waits[other] == others]
            if standing and rivals and all(self.released[other] == self.counts[0][other] for other in rivals):
                early = self.released.copy()
                early[robot] += 1
                self.released = frozen_array(early, "i4")


@attrs.frozen(kw_only=True)
class BlindLeft(Controller):
    """Drives as `pure_pursuit` and stops before what is near ahead, but sees nothing on its left."""

    needs_lidar = True
    near = 0.32

    def start(self, robot, world, period):
        return BlindLeftSession(PurePursuit().start(robot, world, period), robot.lidar, self.near)


class BlindLeftSession(ControllerSession):
    def __init__(self, follows, lidar, near):
        self.follows, self.near = follows, near
        angle = np.arange(lidar.beams) * 2 * np.pi / lidar.beams
        self.ahead = (angle < 0.02) | (angle > 2 * np.pi - 1.0)
        self.blocked = False

    def command(self, observation):
        if observation.scan is not None:
            self.blocked = bool((observation.scan.ranges[0][self.ahead] < self.near).any())
        wanted = self.follows.command(observation)
        return (0.0, 0.0 if wanted is None else wanted[1]) if self.blocked else wanted
