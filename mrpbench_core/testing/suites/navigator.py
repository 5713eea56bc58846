"""Checks that every navigator must pass: two robots with a plain controller in a room."""

import math
from collections.abc import Callable, Sequence

import attrs
import numpy as np

from mrpbench_core.api.controller import Controller, ControllerSession
from mrpbench_core.api.navigator import Navigator
from mrpbench_core.builtin.simulators.kinematic import Kinematic
from mrpbench_core.model.common.arrays import Int32
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.execution.motion import Motion
from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Observation, Odometry
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.route import Route
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.world import World
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.fixtures.room import PERIOD, fleet, room, route
from mrpbench_core.testing.suites.component import ComponentConformance

ROUTES = (
    route((0.6, 0.6), (1.2, 0.6), (1.8, 0.6), (1.8, 1.2)),
    route((3.2, 2.4), (2.6, 2.4), (2.0, 2.4), (2.0, 1.8)),
)
PLACES = np.array([(0.6, 0.6, 0.0), (3.2, 2.4, math.pi)])
LENGTHS = np.array([3, 3], np.int32)
PATIENCE = 90.0
"""simulated seconds for routes of 1.8 m"""
Release = Callable[[float], Int32]


@attrs.frozen(kw_only=True)
class TurnThenDrive(Controller):
    """Turns towards the first waypoint that is not at the robot's place, then drives there and slows down."""

    def start(self, robot: RobotModel, world: World, period: float) -> ControllerSession:  # noqa: ARG002
        """Begin to control one robot."""
        return _TurnThenDrive(robot)


class _TurnThenDrive(ControllerSession):
    def __init__(self, robot: RobotModel) -> None:
        self.robot = robot

    def command(self, observation: Observation) -> tuple[float, float] | None:
        px, py, yaw = observation.pose.tolist()
        aims = [point for point in observation.path.tolist() if math.dist(point, (px, py)) > 0.05]
        x, y = aims[0] if aims else observation.path[-1].tolist()
        distance = math.hypot(x - px, y - py)
        if distance < 0.01:
            return 0.0, 0.0
        error = math.remainder(math.atan2(y - py, x - px) - yaw, math.tau)
        turn = max(-1.0, min(1.0, 2 * error))
        return (min(self.robot.max_speed, distance) if abs(error) < 0.3 else 0.0), turn


class NavigatorConformance(ComponentConformance):
    """Checks of navigators: `class TestMine(NavigatorConformance)`."""

    def make(self) -> Navigator:
        """Return the navigator to check."""
        raise NotImplementedError("define make(self) and return the navigator to check")

    def test_drives_robots_to_the_ends_of_their_routes(self) -> None:
        motions, states = self.drive(lambda _: LENGTHS)
        reached = motions[-1].reached
        require(
            (reached == LENGTHS).all(),
            f"after {len(motions) * PERIOD:.0f} s `reached` is {reached.tolist()}, the routes have 3 segments each",
        )
        ends = np.array([each.waypoint[-1, :2] for each in ROUTES])
        away = float(np.hypot(*(states[-1].pose[:, :2] - ends).T).max())
        require(
            away < 0.4, f"`reached` says that all have arrived, but a robot is {away:.2f} m from the end of its route"
        )

    def test_robots_stop_at_the_end_of_the_released_segments(self) -> None:
        motions, states = self.drive(lambda _: np.array([1, 0], np.int32), seconds=20.0)
        away = np.hypot(*(states[-1].pose[:, :2] - [ROUTES[0].waypoint[1, :2], ROUTES[1].waypoint[0, :2]]).T)
        require(away.max() < 0.35, f"robots are {away.round(2).tolist()} m from the end of what was released")
        require(
            (motions[-1].reached <= (1, 0)).all(), f"`reached` is {motions[-1].reached.tolist()}, released were [1, 0]"
        )

    def test_says_how_far_robots_got(self) -> None:
        motions, _ = self.drive(lambda now: np.minimum(LENGTHS, int(now // 5)).astype(np.int32))
        before = np.zeros((2, 2), int)
        for step, motion in enumerate(motions):
            released = np.minimum(LENGTHS, int(step * PERIOD // 5))
            now = np.array([motion.reached, motion.cleared])
            require(
                (motion.reached <= released).all(),
                f"`reached` is {motion.reached.tolist()}, released were {released.tolist()}",
            )
            require((now >= before).all(), f"reached and cleared decrease: {before.tolist()}, then {now.tolist()}")
            require((motion.cleared <= motion.reached + 1).all(), "`cleared` counts a segment that has not begun")
            before = now

    def test_motions_have_the_shapes_of_the_contract(self) -> None:
        for motion in self.drive(lambda _: LENGTHS, seconds=2.0)[0]:
            require(isinstance(motion, Motion), f"returns {type(motion).__name__} instead of Motion")
            shapes = [motion.twist.shape, motion.reached.shape, motion.cleared.shape, motion.mode.shape]
            require(shapes == [(2, 2), (2,), (2,), (2,)], f"twist, reached, cleared, mode have shapes {shapes}")
            require(np.isfinite(motion.twist).all(), "a twist is not finite: command (0, 0) where there is no command")

    def test_runs_are_equal_to_the_last_bit(self) -> None:
        one, other = (
            b"".join(motion.twist.tobytes() for motion in self.drive(lambda _: LENGTHS, seconds=10.0)[0]) for _ in "12"
        )
        require(one == other, "the same run led to other twists the second time: draw from the given seed only")

    def test_goes_on_with_longer_routes(self) -> None:
        short = [
            attrs.evolve(each, waypoint=each.waypoint[:2], level=each.level[:2], speed=each.speed[:1])
            for each in ROUTES
        ]
        motions, _ = self.drive(lambda now: np.minimum(LENGTHS, 1 if now < 15 else 3), routes=short, adopt_at=15.0)
        reached = motions[-1].reached
        require(
            (reached == LENGTHS).all(),
            f"after adopting longer routes `reached` is {reached.tolist()}, the routes have 3 segments each",
        )

    def drive(
        self,
        release: Release,
        seconds: float = PATIENCE,
        routes: Sequence[Route] = ROUTES,
        adopt_at: float = math.inf,
    ) -> tuple[list[Motion], list[State]]:
        """Motions and true states until all robots have arrived or time is over; `ROUTES` are adopted at `adopt_at`."""
        robots = fleet(2)
        session = self.make().start(robots, room(), routes, TurnThenDrive(), PERIOD, 0)
        motions, states = [], []
        with Kinematic().open(room(), robots, PLACES, 0, PERIOD) as simulation:
            state = simulation.state
            for step in range(round(seconds / PERIOD)):
                now = step * PERIOD
                if now >= adopt_at:
                    session.adopt(ROUTES, np.zeros(2, np.int32))
                    adopt_at = math.inf
                observations = FleetObservation(
                    estimate=Estimate(pose=state.pose),
                    odometry=Odometry(pose=state.pose, twist=state.twist),
                    level=state.level,
                    scans=simulation.scans(),
                )
                motion = session.step(now, observations, Orders(released=release(now)))
                motions.append(motion)
                state = simulation.step(Inputs(twist=motion.twist))
                states.append(state)
                if (motion.reached == LENGTHS).all() and not state.twist.any():
                    break
        return motions, states
