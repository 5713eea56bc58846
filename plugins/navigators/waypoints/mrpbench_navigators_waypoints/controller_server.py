"""Asks the controllers of a fleet for commands, and checks what they return."""

import numpy as np

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.api.controller import FleetControllerSession
from mrpbench_core.model.common.arrays import Bool, Float
from mrpbench_core.model.execution.observation import Observations


class ControllerServer:
    """The controllers of a fleet. As in Nav2, a controller may fail for a while before that counts.

    Args:
        controllers: of all robots.
        name: of the controller, for messages.
        failure_tolerance: simulated seconds for which a controller may know no admissible command.
    """

    def __init__(self, controllers: FleetControllerSession, name: str, failure_tolerance: float) -> None:
        self._controllers, self._name, self._failure_tolerance = controllers, name, failure_tolerance
        self.observe = controllers.observe
        self._without: dict[int, float] = {}
        """Robots that have no admissible command, and when each last had one, or did not need one."""
        self._before = 0.0
        """Simulated second of the control period before."""

    def command(self, observations: Observations) -> tuple[Float, Bool | None]:
        """The commands f8[k,2] of all rows, and whether each is missing: NaN, as none is admissible. None: none is.

        Raises:
            BrokenContractError: the controller returned something else.
        """
        command = self._controllers.command(observations)
        missing = self._check(command, observations.robot)
        if self._without or missing is not None:
            robots = [] if missing is None else observations.robot[missing].tolist()
            self._without = {robot: self._without.get(robot, self._before) for robot in robots}
        return command, missing

    def have_failed(self, now: float) -> list[int]:
        """Return the robots that have had no command for too long, in order; their time begins anew."""
        self._before = now
        failed = [robot for robot, since in self._without.items() if now - since > self._failure_tolerance]
        for robot in failed:
            self._without[robot] = now
        return failed

    def failure_reason(self, robot: int) -> str:
        """Return the reason why there was no admissible command for a robot."""
        return self._controllers.failure_reason(robot)

    def _check(self, command: object, robots: np.ndarray) -> Bool | None:
        """Tell bool[k] which commands are missing, or None if none is."""
        subject = f"the controller {self._name}"
        if not isinstance(command, np.ndarray) or command.shape != (len(robots), 2):
            raise BrokenContractError(f"{subject} returned {command!r} instead of f8[{len(robots)},2]", "controller")
        finite = np.isfinite(command)
        if np.count_nonzero(finite) == command.size:
            return None
        missing: Bool = np.isnan(command[:, 0]) & np.isnan(command[:, 1])
        wrong = ~finite.all(axis=1) & ~missing
        if wrong.any():
            row = int(wrong.argmax())
            raise BrokenContractError(
                f"{subject} returned {command[row].tolist()} for robot {robots[row]}", "controller"
            )
        return missing
