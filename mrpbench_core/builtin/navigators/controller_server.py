"""Asks the controllers of a fleet for commands, and checks what they return."""

import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.execution.observation import Observations


class ControllerServer:
    """The controllers of a fleet. As in Nav2, a controller may fail for a while before that counts.

    Args:
        robots: number of robots.
        controllers: of these robots.
        name: of the controller, for messages.
        failure_tolerance: simulated seconds for which a controller may know no admissible command.
    """

    def __init__(self, robots: int, controllers: FleetControllerSession, name: str, failure_tolerance: float) -> None:
        self._controllers, self._name, self._failure_tolerance = controllers, name, failure_tolerance
        self._commanded: Float = np.zeros(robots)
        """f8[n]: when each robot last had an admissible command, or need not have one."""

    def command(self, observations: Observations) -> Float:
        """The commands f8[k,2] of all rows, NaN where none is admissible.

        Raises:
            BrokenContractError: the controller returned something else.
        """
        command = self._controllers.command(observations)
        self._check(command, observations.robot)
        self._commanded[observations.robot[~np.isnan(command[:, 0])]] = observations.now
        return command

    def have_failed(self, now: float, following: Bool) -> Bool:
        """Tell bool[n] which robots that follow have had no command for too long; their time begins anew."""
        failed: Bool = following & (now - self._commanded > self._failure_tolerance)
        self._commanded[~following | failed] = now
        return failed

    def failure_reason(self, robot: int) -> str:
        """Return the reason why there was no admissible command for a robot."""
        return self._controllers.failure_reason(robot)

    def _check(self, command: object, robots: np.ndarray) -> None:
        subject = f"the controller {self._name}"
        if not isinstance(command, np.ndarray) or command.shape != (len(robots), 2):
            raise BrokenContractError(f"{subject} returned {command!r} instead of f8[{len(robots)},2]")
        if np.isfinite(command).all():
            return
        wrong = ~np.isfinite(command).all(axis=1) & ~np.isnan(command).all(axis=1)
        if wrong.any():
            row = int(wrong.argmax())
            raise BrokenContractError(f"{subject} returned {command[row].tolist()} for robot {robots[row]}")
