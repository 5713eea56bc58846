"""Checks that every controller must pass: one TurtleBot3 Burger that executes commands exactly."""

import math
from collections.abc import Sequence

import attrs
import numpy as np

from mrpbench_core.api.controller import Controller, ControllerSession
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.execution.observation import Observation, Observations
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.fixtures.room import PERIOD, ROBOT, driven, room
from mrpbench_core.testing.suites.component import ComponentConformance

Point = tuple[float, float]
START = np.array([1.0, 1.0, 0.0])
STRAIGHT = ((1.5, 1.0), (2.0, 1.0), (2.5, 1.0))
CORNER = ((1.6, 1.0), (2.2, 1.0), (2.2, 1.6), (2.2, 2.2))
PASSED = 0.12
"""Metres from a waypoint at which the path ahead begins with the next one."""
REACHED = 0.15
"""Metres from the end of the path within which a robot must stop."""
PATIENCE = 40.0
"""Simulated seconds for paths of less than 3 m."""


@attrs.frozen
class Drive:
    """Poses and commands of a robot, one for each control period."""

    pose: Float
    """f8[t,3]"""
    twist: Float
    """f8[t,2] commands in m/s, rad/s"""


class PathAhead:
    """The part of a path from `START` that is ahead, as the navigator `waypoints` passes it on."""

    def __init__(self, path: Sequence[Point]) -> None:
        self.points = [START[:2], *map(np.array, path)]

    def ahead(self, pose: Float) -> Float:
        """The nearest point of the leg that the robot is on, then the waypoints ahead: f8[k,2]."""
        while len(self.points) > 2 and np.hypot(*(pose[:2] - self.points[1])) < PASSED:
            self.points.pop(0)
        begin, end = self.points[:2]
        along = end - begin
        length = float(along @ along)
        share = np.clip((pose[:2] - begin) @ along / length, 0.0, 1.0) if length else 1.0
        return np.array([begin + share * along, *self.points[1:]])


class ControllerConformance(ComponentConformance):
    """Checks of controllers: `class TestMine(ControllerConformance)`."""

    def make(self) -> Controller:
        """Return the controller to check."""
        raise NotImplementedError("define make(self) and return the controller to check")

    def start(self) -> ControllerSession:
        """A session for one robot in the room."""
        return self.make().start(ROBOT, room(), PERIOD)

    def test_commands_are_within_the_limits_of_the_robot(self) -> None:
        for path in (STRAIGHT, CORNER):
            twist = drive(self.start(), path).twist
            require(
                np.isfinite(twist).all(), "commands a speed that is not finite: return None if no command is admissible"
            )
            fastest, spin = np.abs(twist).max(axis=0)
            require(
                fastest <= ROBOT.max_speed + 1e-6, f"commands {fastest:.3f} m/s, the robot's limit is {ROBOT.max_speed}"
            )
            require(
                spin <= ROBOT.max_turn_rate + 1e-6, f"commands {spin:.3f} rad/s, the limit is {ROBOT.max_turn_rate}"
            )

    def test_keeps_the_speed_that_is_allowed(self) -> None:
        fastest = drive(self.start(), STRAIGHT, speed=0.1).twist[:, 0].max()
        require(fastest <= 0.1 + 1e-6, f"commands {fastest:.3f} m/s where 0.1 m/s is allowed")

    def test_comes_to_the_end_of_a_straight_path_and_stops(self) -> None:
        comes_to_the_end(drive(self.start(), STRAIGHT), STRAIGHT)

    def test_comes_round_a_corner_and_stops(self) -> None:
        comes_to_the_end(drive(self.start(), CORNER), CORNER)

    def test_turns_towards_the_path(self) -> None:
        for side, target in ((1, (1.0, 2.0)), (-1, (1.0, 0.3))):
            turned = side * drive(self.start(), (target,), seconds=3.0).pose[-1, 2]
            word = "left" if side > 0 else "right"
            require(
                turned > 0.2,
                f"the path leads to the {word}, but after 3 s the robot has turned {turned:.2f} rad to that side",
            )

    def test_a_robot_at_the_end_stays(self) -> None:
        twist = drive(self.start(), (tuple(START[:2].tolist()),), seconds=2.0).twist
        require(np.abs(twist[-10:, 0]).max() < 0.05, "keeps driving at the end of its path: command (0, 0) there")

    def test_the_same_observations_give_the_same_commands(self) -> None:
        one, other = drive(self.start(), CORNER), drive(self.start(), CORNER)
        require(
            np.array_equal(one.twist, other.twist),
            "commands differ the second time: keep all state in the session, draw by the seed alone",
        )

    def test_robots_do_not_disturb_one_another(self) -> None:
        alone = [self._drive_one_of_two(robot, path) for robot, path in enumerate((STRAIGHT, CORNER))]
        together = self.make().start_fleet([ROBOT, ROBOT], room(), PERIOD)
        poses, twists = np.array([START, START]), np.zeros((2, 2))
        tracks = [PathAhead(STRAIGHT), PathAhead(CORNER)]
        said = []
        for step in range(round(5.0 / PERIOD)):
            answers = together.command(observations(step, poses, twists, tracks))
            shape = np.shape(answers)
            require(shape == (2, 2), f"start_fleet: commands of shape {shape} when asked for two robots")
            twists = np.nan_to_num(answers)
            said.append(twists)
            poses = driven(poses, twists, PERIOD)
        first = np.array(said)
        for robot in range(2):
            same = np.allclose(first[: len(alone[robot]), robot], alone[robot][: len(first)], atol=1e-9)
            require(
                same,
                "a robot gets other commands when a second one is controlled in the same call: keep their states apart",
            )

    def _drive_one_of_two(self, robot: int, path: Sequence[Point]) -> Float:
        """The commands f8[t,2] of one robot of two, each of which may have noise of its own; the other one waits."""
        session = self.make().start_fleet([ROBOT, ROBOT], room(), PERIOD)
        pose, twist, track, said = START[None], np.zeros((1, 2)), PathAhead(path), []
        for step in range(round(5.0 / PERIOD)):
            observed = observations(step, pose, twist, [track])
            fleet_pose = np.array([START, START])
            observed = attrs.evolve(observed, robot=np.array([robot]), fleet_pose=fleet_pose)
            twist = np.nan_to_num(session.command(observed))
            said.append(twist[0])
            pose = driven(pose, twist, PERIOD)
        return np.array(said)

    def test_optional_methods_return_valid_values(self) -> None:
        session = self.start()
        observed = observation(0, START, np.zeros(2), PathAhead(STRAIGHT).ahead(START))
        session.command(observed)
        session.clear()
        poses = np.array([START, (2.0, 1.0, 1.0), (2.5, 1.5, -1.0)])
        free = np.asarray(session.is_free(poses))
        require(free.shape == (3,) and free.dtype == bool, f"is_free returns {free!r} for three poses")
        for question, way in (("reroute", session.reroute(observed)), ("approach", session.approach(observed, 0.5))):
            right = way is None or (np.asarray(way).ndim == 2 and np.asarray(way).shape[1] == 2)
            require(right, f"{question} returns {way!r} instead of f8[k,2] or None")


def comes_to_the_end(driving: Drive, path: Sequence[Point]) -> None:
    """Require that a robot reached the end of its path and stopped there."""
    away = float(np.hypot(*(driving.pose[-1, :2] - path[-1])))
    require(
        away < REACHED, f"after {len(driving.pose) * PERIOD:.0f} s the robot is {away:.2f} m from the end of the path"
    )
    speed = float(np.abs(driving.twist[-1, 0]))
    require(speed < 0.02, f"at the end of its path the robot drives at {speed:.3f} m/s")


def drive(
    session: ControllerSession, path: Sequence[Point], seconds: float = PATIENCE, speed: float = math.inf
) -> Drive:
    """Execute commands exactly, until the robot rests at the end of its path or time is over."""
    pose, twist = START.copy(), np.zeros(2)
    poses, twists = [], []
    at_rest = 0
    track = PathAhead(path)
    for step in range(round(seconds / PERIOD)):
        command = session.command(observation(step, pose, twist, track.ahead(pose), speed))
        require(
            command is None or len(command) == 2, f"command returns {command!r} instead of (speed, turn rate) or None"
        )
        twist = np.array(command or (0.0, 0.0), float)
        pose = driven(pose[None], twist[None], PERIOD)[0]
        poses.append(pose)
        twists.append(twist)
        near = np.hypot(*(pose[:2] - path[-1])) < REACHED and abs(twist[0]) < 0.02
        at_rest = at_rest + 1 if near else 0
        if at_rest == 40:  # two seconds
            break
    return Drive(np.array(poses), np.array(twists))


def observations(step: int, poses: Float, twists: Float, tracks: Sequence[PathAhead]) -> Observations:
    """The inputs of the controllers of several robots; see `observation`."""
    paths = [track.ahead(pose) for track, pose in zip(tracks, poses, strict=True)]
    ends = np.cumsum([len(path) - 1 for path in paths])
    return Observations(
        now=step * PERIOD,
        robot=np.arange(len(paths)),
        pose=np.column_stack([poses[:, :2], np.remainder(poses[:, 2] + np.pi, 2 * np.pi) - np.pi]),
        twist=twists,
        foot=np.array([path[0] for path in paths]),
        points=np.concatenate([path[1:] for path in paths]),
        begin=np.append(0, ends[:-1]),
        end=ends,
        yaw=np.full(len(paths), math.nan),
        speed=np.full(len(paths), math.inf),
        fleet_pose=poses,
    )


def observation(step: int, pose: Float, twist: Float, path: Float, speed: float = math.inf) -> Observation:
    """The inputs of a controller, without scans, which may be missing in any period."""
    yaw = math.remainder(pose[2], math.tau)
    return Observation(now=step * PERIOD, pose=np.array([pose[0], pose[1], yaw]), twist=twist, path=path, speed=speed)
