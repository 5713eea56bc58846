"""Checks that every recovery must pass: one robot that does what it is told, or that cannot move."""

from typing import Any

import numpy as np

from mrpbench_core.api.recovery import Recovery, Surroundings
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.testing.faults import Fault, require
from mrpbench_core.testing.fixtures.room import PERIOD, ROBOT, driven
from mrpbench_core.testing.suites.component import ComponentConformance

START = np.array([2.0, 1.5, 0.5])
PATIENCE = 120.0
"""Simulated seconds after which an attempt must have ended."""


class Everywhere(Surroundings):
    """Surroundings in which all poses are free, or none."""

    def __init__(self, free: bool) -> None:
        self._free = free

    def clear(self) -> None:
        """Nothing is marked."""

    def is_free(self, poses: Float) -> Bool:
        """Return the same for all poses."""
        return np.full(len(poses), self._free)

    def heading(self) -> float:
        """Return another yaw than that of the robot."""
        return -1.5


class RecoveryConformance(ComponentConformance):
    """Checks of recoveries: `class TestMine(RecoveryConformance)`."""

    def make(self) -> Recovery:
        """Return the recovery to check."""
        raise NotImplementedError("define make(self) and return the recovery to check")

    def test_commands_are_within_the_limits_of_the_robot(self) -> None:
        for moves in (True, False):
            twist, _ = self.attempt(free=True, moves=moves)
            fastest, spin = np.abs(twist).max(axis=0, initial=0.0)
            require(
                fastest <= ROBOT.max_speed + 1e-9,
                f"commands {fastest:.3f} m/s: keep to `robot.max_speed`, here {ROBOT.max_speed:g}",
            )
            require(
                spin <= ROBOT.max_turn_rate + 1e-9,
                f"commands {spin:.3f} rad/s: keep to `robot.max_turn_rate`, here {ROBOT.max_turn_rate:g}",
            )

    def test_an_attempt_ends_also_if_the_robot_cannot_move(self) -> None:
        for free in (True, False):
            for moves in (True, False):
                self.attempt(free, moves)

    def test_a_robot_with_no_free_pose_around_it_is_not_moved(self) -> None:
        _, away = self.attempt(free=False, moves=True)
        require(
            away < 0.01,
            f"moves the robot by {away:.2f} m although no pose is free: ask `surroundings.is_free` before each motion",
        )

    def test_the_same_attempt_gives_the_same_commands(self) -> None:
        (one, _), (other, _) = self.attempt(True, True), self.attempt(True, True)
        require(np.array_equal(one, other), "commands differ the second time: keep all state in the session")

    def test_attempts_do_not_disturb_one_another(self) -> None:
        alone, _ = self.attempt(True, True)
        recovery = self.make()
        recovery.start(ROBOT, Everywhere(True), PERIOD).step(0.0, START + 1.0, np.zeros(2))
        together, _ = self.attempt(True, True, recovery)
        require(np.array_equal(alone, together), "another attempt changes the commands: keep all state in the session")

    def attempt(self, free: bool, moves: bool, recovery: Recovery | None = None) -> tuple[Float, float]:
        """Commands f8[k,2] of an attempt until it ends, and the largest distance from its start in metres."""
        session = (recovery or self.make()).start(ROBOT, Everywhere(free), PERIOD)
        pose, twist, away = START.copy(), np.zeros(2), 0.0
        twists: list[Float] = []
        for step in range(round(PATIENCE / PERIOD)):
            answer: Any = session.step(step * PERIOD, pose.copy(), twist.copy())
            if isinstance(answer, bool):
                return np.array(twists).reshape(-1, 2), away
            pair = isinstance(answer, tuple | list) and len(answer) == 2
            require(pair, f"step returns {answer!r}: return (speed, turn rate), or True or False at the end")
            command = np.array(answer, float)
            require(np.isfinite(command).all(), f"step returns {answer!r}: speeds must be finite")
            twists.append(command)
            twist = command if moves else np.zeros(2)
            pose = driven(pose[None], twist[None], PERIOD)[0]
            away = max(away, float(np.hypot(*(pose - START)[:2])))
        what = "does what it is told" if moves else "cannot move"
        raise Fault(f"has not ended after {PATIENCE:.0f} s with a robot that {what}: return False after a time")
