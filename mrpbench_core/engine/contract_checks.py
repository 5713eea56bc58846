"""Checks the return values of components against their contracts, most of them in every control period.

Arrays of a wrong shape broadcast, and comparisons with NaN are false: without this a defect of a plugin would not stop
the run but spoil its numbers.
"""

from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.model.arrays import Int32
from mrpbench_core.model.execution import Estimate, Mode, Motion, Orders, ScanBatch, State
from mrpbench_core.model.scenario import Scenario

_LAST_MODE = int(max(Mode))


class ContractChecks:
    """Checks the return values of one execution; each method returns its argument.

    An array that is the same object as in the last period is not checked again: returned arrays do not change.

    Args:
        length: i8[n] segments of each robot's path.
    """

    def __init__(self, length: NDArray[Any]) -> None:
        self.length = length
        self._robots = len(length)
        nothing: Int32 = np.zeros(self._robots, np.int32)
        self._released = self._reached = self._cleared = nothing

    def adopt(self, length: NDArray[Any]) -> None:
        """Go on with the paths of a new plan."""
        self.length = length
        self._released = self._released.copy()  # so that the next answer is looked at

    def state(self, state: State) -> State:
        """Check the answer of a simulator."""
        who = "the simulator"
        self._is(who, state, State)
        self._finite(who, "pose", state.pose)
        self._finite(who, "twist", state.twist)
        self._one_each(who, "level", state.level)
        one, other = state.contacts.T
        if (
            len(one)
            and ((one < 0) | (one >= self._robots) | (other < -1) | (other >= self._robots) | (one == other)).any()
        ):
            _refuse(who, "contacts that name no robot, or a robot twice")
        return state

    def scans(self, batches: tuple[ScanBatch, ...]) -> tuple[ScanBatch, ...]:
        """Check the answer of a simulator."""
        for batch in batches:
            self._is("the simulator", batch, ScanBatch)
            if batch.robot.ndim != 1 or batch.ranges.ndim != 2 or len(batch.robot) != len(batch.ranges):
                _refuse("the simulator", f"ranges of shape {batch.ranges.shape} for robots {batch.robot.tolist()}")
            if ((batch.robot < 0) | (batch.robot >= self._robots)).any():
                _refuse("the simulator", "a scan of a robot that does not exist")
            if not (batch.ranges >= 0).all():
                _refuse("the simulator", "ranges that are negative or no numbers")
        return batches

    def estimate(self, estimate: Estimate) -> Estimate:
        """Check the answer of a localizer."""
        self._is("the localizer", estimate, Estimate)
        self._finite("the localizer", "pose", estimate.pose)
        if estimate.covariance is not None and np.shape(estimate.covariance) != (self._robots, 3, 3):
            _refuse("the localizer", f"a covariance of shape {np.shape(estimate.covariance)}")
        return estimate

    def orders(self, orders: Orders) -> Orders:
        """Check the answer of a dispatcher."""
        who = "the dispatcher"
        self._is(who, orders, Orders)
        if orders.released is self._released:
            return orders
        self._one_each(who, "released", orders.released)
        self._no_robot(who, "released less than before", orders.released < self._released)
        self._no_robot(who, "released more segments than there are", orders.released > self.length)
        self._released = orders.released
        return orders

    def motion(self, motion: Motion) -> Motion:
        """Check the answer of a navigator, after the orders that it got."""
        who = "the navigator"
        self._is(who, motion, Motion)
        self._finite(who, "twist", motion.twist)
        for name in ("reached", "cleared", "mode"):
            self._one_each(who, name, getattr(motion, name))
        if motion.reached is not self._reached or motion.cleared is not self._cleared:
            self._no_robot(who, "reached less than before", motion.reached < self._reached)
            self._no_robot(who, "reached what was not released", motion.reached > self._released)
            self._no_robot(who, "cleared less than before", motion.cleared < self._cleared)
            self._no_robot(who, "cleared what it had not come to", motion.cleared > motion.reached + 1)
            self._reached, self._cleared = motion.reached, motion.cleared
        self._no_robot(who, "a mode that does not exist", motion.mode > _LAST_MODE)
        return motion

    def _is(self, who: str, answer: object, wanted: type) -> None:
        if not isinstance(answer, wanted):
            _refuse(who, f"{type(answer).__name__} instead of {wanted.__name__}")

    def _finite(self, who: str, name: str, values: NDArray[Any]) -> None:
        if len(values) != self._robots:
            _refuse(who, f"{name} of {len(values)} robots instead of {self._robots}")
        if not np.isfinite(values).all():
            robot = int(np.flatnonzero(~np.isfinite(values).all(axis=1))[0])
            _refuse(who, f"for robot {robot} the {name} {values[robot].tolist()}, which is not finite")

    def _one_each(self, who: str, name: str, values: NDArray[Any]) -> None:
        if values.shape != (self._robots,):
            _refuse(who, f"{name} of shape {values.shape} for {self._robots} robots")

    def _no_robot(self, who: str, what: str, bad: NDArray[np.bool_]) -> None:
        if bad.any():
            _refuse(who, f"for robot {int(bad.argmax())}: {what}")


def check_drawn(scenario: Scenario, robots: int) -> Scenario:
    """Check a scenario, on which other components rely for the number of robots."""
    if not len(scenario.start) == len(scenario.start_level) == robots:
        _refuse("the scenario", f"{len(scenario.start)} starts for {robots} robots")
    for place, rows in (
        ("start", scenario.start),
        *((f"goal of {task.name!r}", task.goals) for task in scenario.tasks),
    ):
        if not len(rows) or not np.isfinite(rows[:, :2]).all():
            _refuse("the scenario", f"a {place} that is nowhere")
    return scenario


def check_kept(kept: Any, waypoints: int) -> NDArray[np.bool_]:
    """Check the answer of a plan filter."""
    if not isinstance(kept, np.ndarray) or kept.dtype != bool or kept.shape != (waypoints,):
        _refuse("the plan filter", f"something other than bool[{waypoints}]")
    if not (kept[0] and kept[-1]):
        _refuse("the plan filter", "a path without its start or its end")
    return kept


def _refuse(who: str, what: str) -> NoReturn:
    raise BrokenContractError(f"{who} returned {what}")
