"""Checks that what components return, most of it in every control period, meets their contracts.

Arrays of a wrong shape broadcast, and comparisons with NaN are false: without these checks a defect of a plugin would
not stop the run but falsify its numbers.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NoReturn, TypeVar

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api.component import Component
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.checking.covariances import check_covariances
from mrpbench_core.checking.recording import LARGEST, axis_of, check_channel, check_names
from mrpbench_core.model.common.arrays import Byte, Float, Int, Int16, Int32, frozen_array
from mrpbench_core.model.execution.motion import Mode, Motion
from mrpbench_core.model.execution.observation import Estimate, ScanBatch
from mrpbench_core.model.execution.orders import BatchOrders, Orders
from mrpbench_core.model.execution.state import State
from mrpbench_core.model.planning.scenario import MOST_ROBOTS, Scenario, Task
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.plugins.kinds import kind_of

T = TypeVar("T")
_LAST_MODE = int(max(Mode))
_TURN = 7.0
"""Radians by which a yaw may change without a closer look; more than a whole turn, since it may be wrapped."""
_MOST_KNOWN = 256
"""Arrays of indices that are remembered."""
EARLY = 1e-6
"""Seconds by which a scan may be ahead of the clock, because times are rounded."""


class ContractChecks:
    """Checks what the components of one execution return.

    Args:
        length: i8[n] segments of each robot's path.
        reach: f8[n] metres that each robot can possibly move in one control period; None = not checked.
        movers: number of movers.
        levels: number of levels of the world.
        facilities: names of its doors and lifts.
        beams: i8[n] beams of the lidar of each robot, 0 = it has none; None = not checked.
    """

    def __init__(
        self,
        length: NDArray[Any],
        reach: NDArray[Any] | None = None,
        movers: int = 0,
        *,
        levels: int = 1,
        facilities: Collection[str] = (),
        beams: NDArray[Any] | None = None,
    ) -> None:
        self.length = length
        self._levels, self._facilities, self._beams = levels, frozenset(facilities), beams
        self._scanned = -np.inf
        """Time of the last scan."""
        self._scanning: dict[tuple[int, int], Int32] = {}
        """Indices i4[k] of robots that scanned, by the identity of the array and their number of beams."""
        self._reach = np.inf if reach is None else reach
        self._box = np.full((len(length), 3), _TURN)
        """f8[n,3]: robots whose poses change by no more have finite poses, and are where they can be."""
        if reach is None:
            self._box[:] = -1.0  # no pose is
        else:
            self._box[:, :2] = np.where(np.isfinite(reach), reach / 1.5, -1.0)[:, None]
        self._before: State | None = None
        self._robots, self._movers = len(length), movers
        nothing: Int32 = np.zeros(self._robots, np.int32)
        self._released = self._reached = self._cleared = nothing
        self._mode: Byte | None = None
        self._least: Int = np.zeros((1, self._robots), np.int64)
        """What `batch` orders must release at least."""
        self._limits_speed: bool | None = None
        """Whether the dispatcher limits speeds."""

    def adopt(self, length: NDArray[Any], cut: Int32) -> None:
        """Continue with the paths of a new plan, which leave out the first `cut` i4[n] segments."""
        self.length = length
        self._released, self._reached = self._released - cut, self._reached - cut
        self._cleared = np.maximum(self._cleared - cut, 0)

    def state(self, state: State, push: float = 0.0) -> State:
        """Check the state that a simulator returns; movers may have pushed robots by `push` metres at once."""
        kind, before = "the simulator", self._before
        _require_class(kind, state, State)
        close = before is not None and self._is_close(state.pose, before.pose)
        if not close:
            self._finite(kind, "pose", state.pose)
        self._finite(kind, "twist", state.twist)
        if before is None or (state.level is not before.level and not np.array_equal(state.level, before.level)):
            self._one_each(kind, "level", state.level)
            self._no_robot(kind, "a level that does not exist", (state.level < 0) | (state.level >= self._levels))
        if state.facilities or self._facilities or type(state.facilities) is not dict:
            self._check_facilities(state.facilities)
        if len(state.contacts):
            self._check_contacts(state.contacts, state.contact_force)
        if before is not None and not close:
            shift = state.pose - before.pose
            moved = np.hypot(shift[:, 0], shift[:, 1])
            self._no_robot(
                kind, "a position that it cannot have reached in one control period", moved > self._reach + push
            )
        self._before = state
        return state

    def _is_close(self, pose: Float, before: Float) -> bool:
        """Tell whether all poses f8[n,3] are finite and surely within reach of those `before`: a quick check."""
        return pose.shape == before.shape and np.count_nonzero(np.abs(pose - before) <= self._box) == pose.size

    def _check_facilities(self, states: Any) -> None:
        kind, before = "the simulator", self._before
        if not isinstance(states, Mapping):
            _refuse(kind, f"{type(states).__name__} instead of the state of doors and lifts")
        if (states and states.keys() != self._facilities) or (
            before is not None and states.keys() != before.facilities.keys()
        ):
            _refuse(kind, "other doors and lifts than there are")
        for name, value in states.items():
            if not (isinstance(value, float | int) and abs(value) <= LARGEST):
                _refuse(kind, f"for {name!r} the state {value!r:.40}")

    def _check_contacts(self, contacts: Int32, force: Float | None) -> None:
        one, other = contacts.T
        wrong = (one < 0) | (one >= self._robots) | (other < -1) | (other >= self._robots + self._movers)
        if (wrong | (one == other)).any():
            _refuse("the simulator", "contacts that name no robot, or a robot twice")
        if force is not None and np.shape(force) != one.shape:
            _refuse("the simulator", f"forces of shape {np.shape(force)} for {len(one)} contacts")

    def scans(self, batches: Sequence[ScanBatch], now: float) -> tuple[ScanBatch, ...]:
        """Check the scans that a simulator returns at `now`; indices of robots cannot change and are checked once."""
        if not isinstance(batches, tuple | list):
            _refuse("the simulator", f"{type(batches).__name__} instead of scans")
        for batch in batches:
            _require_class("the simulator", batch, ScanBatch)
            if not (isinstance(batch.stamp, float | int) and self._scanned <= batch.stamp <= now + EARLY):
                _refuse(
                    "the simulator", f"a scan of the time {batch.stamp!r:.40} at {now:g} s, after {self._scanned:g} s"
                )
            self._scanned = batch.stamp
            if batch.robot.ndim != 1 or batch.ranges.ndim != 2 or len(batch.robot) != len(batch.ranges):
                _refuse("the simulator", f"ranges of shape {batch.ranges.shape} for robots {batch.robot.tolist()}")
            if np.count_nonzero(batch.ranges >= 0) < batch.ranges.size:
                _refuse("the simulator", "ranges that are negative or no numbers")
            key = id(batch.robot), batch.ranges.shape[1]
            if key not in self._scanning:
                self._check_scanning(batch.robot, batch.ranges.shape[1])
                if len(self._scanning) >= _MOST_KNOWN:
                    self._scanning.clear()
                self._scanning[key] = batch.robot
        return tuple(batches)

    def _check_scanning(self, robots: Int32, beams: int) -> None:
        if np.count_nonzero(robots.astype(np.uint64) >= self._robots):  # as negative numbers are then
            _refuse("the simulator", "a scan of a robot that does not exist")
        if self._beams is not None and np.count_nonzero(self._beams[robots] != beams):
            _refuse("the simulator", f"scans of {beams} beams by robots that have other lidars")

    def estimate(self, estimate: Estimate) -> Estimate:
        """Check the estimate that a localizer returns."""
        _require_class("the localizer", estimate, Estimate)
        if self._before is None or estimate.pose is not self._before.pose:  # that of the simulator is checked
            self._finite("the localizer", "pose", estimate.pose)
        if estimate.covariance is not None:
            fault = check_covariances(estimate.covariance, self._robots)
            if fault is not None:
                _refuse("the localizer", fault)
        return estimate

    def maps(self, changes: Chunk) -> Chunk:
        """Check what a localizer says about its maps."""
        if type(changes) is dict and not changes:  # as in nearly every control period
            return changes
        faults: list[str | None] = [f"has {name}" for name in changes if axis_of(name) != "map_time"]
        faults += check_names(changes) if not faults else []
        faults += [check_channel(*row, changes["map_time"], self._robots) for row in changes.items() if not faults]
        for fault in filter(None, faults):
            _refuse("the localizer", f"changes of maps: {fault}")
        return changes

    def orders(self, orders: Orders) -> Orders:
        """Check the orders that a dispatcher returns."""
        kind = "the dispatcher"
        _require_class(kind, orders, Orders)
        self._one_each(kind, "released", orders.released)
        self._no_robot(kind, "released less than before", orders.released < self._released)
        self._no_robot(kind, "released more segments than there are", orders.released > self.length)
        if len(orders.speed):
            self._one_each(kind, "speed", orders.speed)
            self._no_robot(kind, "a speed that is not above 0", ~(orders.speed > 0))
        if orders.in_step and not self._exist(orders.in_step):
            _refuse(kind, "a group of robots or segments that do not exist")
        if self._limits_speed not in (None, bool(len(orders.speed))):
            _refuse(kind, "speeds at some times and none at others")
        self._limits_speed = bool(len(orders.speed))
        self._released = orders.released
        return orders

    def waits_for(self, robots: Sequence[int] | None) -> list[int] | None:
        """Check the robots for which a robot waits, as a dispatcher names them."""
        if robots is None:
            return None
        others = [int(robot) for robot in robots]
        if any(not 0 <= robot < self._robots for robot in others):
            _refuse("the dispatcher", f"robots {others} for which a robot waits, and not all of them exist")
        return others

    def batch(self, orders: BatchOrders, executions: int) -> BatchOrders:
        """Check the orders for several executions that a dispatcher returns."""
        kind = "the dispatcher"
        _require_class(kind, orders, BatchOrders)
        released, in_step = orders.released, orders.in_step
        if released.shape != (executions, self._robots):
            _refuse(kind, f"released of shape {released.shape} for {executions} executions of {self._robots} robots")
        self._no_robot(kind, "released less than before", np.any(released < self._least, axis=0))
        self._no_robot(kind, "released more segments than there are", np.any(released > self.length, axis=0))
        limits = len(in_step), executions, self._robots, self.length.max(initial=0)
        if len(in_step) and (in_step.min() < 0 or (in_step.max(axis=0) >= limits).any()):
            _refuse(kind, "a group of robots, executions or segments that do not exist")
        self._least = released
        return orders

    def motion(self, motion: Motion) -> Motion:
        """Check the motion that a navigator returns, after the orders of the same period."""
        kind = "the navigator"
        _require_class(kind, motion, Motion)
        self._finite(kind, "twist", motion.twist)
        if motion.reached is not self._reached or motion.cleared is not self._cleared:
            self._check_progress(motion.reached, motion.cleared)
        if motion.mode is not self._mode:
            self._one_each(kind, "mode", motion.mode)
            self._no_robot(kind, "a mode that does not exist", motion.mode > _LAST_MODE)
            self._mode = motion.mode
        return motion

    def _check_progress(self, reached: Int32, cleared: Int32) -> None:
        """Check counts of segments that differ from those of the period before; what is released never decreases."""
        kind = "the navigator"
        self._one_each(kind, "reached", reached)
        self._one_each(kind, "cleared", cleared)
        less, unreleased = reached < self._reached, reached > self._released
        back, unreached = cleared < self._cleared, cleared > reached + 1
        if np.count_nonzero(less | unreleased | back | unreached):
            self._no_robot(kind, "reached less than before", less)
            self._no_robot(kind, "reached what was not released", unreleased)
            self._no_robot(kind, "cleared less than before", back)
            self._no_robot(kind, "cleared what it had not come to", unreached)
        self._reached, self._cleared = reached, cleared

    def _exist(self, groups: Any) -> bool:
        """Tell whether the robots and segments of groups that rotate exist."""
        try:
            robot, segment = np.array([member for group in groups for member in group], np.int64).reshape(-1, 2).T
        except (TypeError, ValueError):
            return False
        here = (robot >= 0) & (robot < self._robots)
        return bool(here.all() and ((segment >= 0) & (segment < self.length[robot])).all())

    def _finite(self, kind: str, name: str, values: NDArray[Any]) -> None:
        if len(values) != self._robots:
            _refuse(kind, f"{name} of {len(values)} robots instead of {self._robots}")
        sound = np.abs(values) <= LARGEST
        if np.count_nonzero(sound) < values.size:  # several times as fast as `all`, here and below
            robot = int(np.flatnonzero(~sound.all(axis=1))[0])
            fault = "too large" if np.isfinite(values[robot]).all() else "not finite"
            _refuse(kind, f"for robot {robot} the {name} {values[robot].tolist()}, which is {fault}")

    def _one_each(self, kind: str, name: str, values: NDArray[Any]) -> None:
        if values.shape != (self._robots,):
            _refuse(kind, f"{name} of shape {values.shape} for {self._robots} robots")

    def _no_robot(self, kind: str, what: str, bad: NDArray[np.bool_]) -> None:
        if np.count_nonzero(bad):
            _refuse(kind, f"for robot {int(bad.argmax())}: {what}")


def check_returned(component: Component, returned: T, wanted: type) -> T:
    """Check the class of what a component returns."""
    _require_class(_component_kind(component), returned, wanted)
    return returned


def _component_kind(component: Component) -> str:
    return f"the {kind_of(component.group).replace('_', ' ')}"


def check_made(kind: str, fault: str | None) -> None:
    """Check what a component made, of which something else found a fault."""
    if fault is not None:
        _refuse(kind, f"what cannot be: {fault}")


def check_released(tasks: Any) -> Sequence[Task]:
    """Check the class of what a stream of tasks returns."""
    if not isinstance(tasks, Sequence):
        _refuse("the task source", f"{type(tasks).__name__} instead of tasks")
    for task in tasks:
        _require_class("the task source", task, Task)
    return tasks


def check_places(places: Any) -> tuple[Float, Int16] | None:
    """Check the places at which a stream of tasks says that errands may be."""
    if places is None:
        return None
    try:
        position, level = frozen_array(places[0], "f8", 2), frozen_array(places[1], "i2")
    except (TypeError, ValueError, IndexError, KeyError) as error:
        _refuse("the task source", f"something other than places: {error}")
    if level.shape != (len(position),):
        _refuse("the task source", f"{len(position)} places and levels of shape {level.shape}")
    return position, level


def check_ended(ended: Any) -> bool:
    """Check whether a stream of tasks says that it has ended."""
    if not isinstance(ended, bool | np.bool_):
        _refuse("the task source", f"{type(ended).__name__} instead of whether it has ended")
    return bool(ended)


def check_size(robots: Any) -> int:
    """Check the number of robots that a scenario says."""
    if not isinstance(robots, int | np.integer) or not 0 <= robots <= MOST_ROBOTS:
        _refuse("the scenario", f"{robots!r:.40} instead of a number of robots")
    return int(robots)


def check_drawn(scenario: Scenario, robots: int) -> Scenario:
    """Check a drawn scenario: later stages rely on its number of robots."""
    if not len(scenario.start) == len(scenario.start_level) == robots:
        _refuse("the scenario", f"{len(scenario.start)} starts for {robots} robots")
    for place, rows in (
        ("start", scenario.start),
        *((f"goal of {task.name!r}", task.goals) for task in scenario.tasks),
    ):
        if not len(rows) or not np.isfinite(rows[:, :2]).all() or np.isinf(rows).any():
            _refuse("the scenario", f"a {place} that is nowhere")
    return scenario


def _require_class(kind: str, returned: object, wanted: type) -> None:
    if not isinstance(returned, wanted):
        _refuse(kind, f"{type(returned).__name__} instead of {wanted.__name__}")


def _refuse(kind: str, what: str) -> NoReturn:
    word = kind.removeprefix("the ")
    raise BrokenContractError(f"{kind} returned {what}", "tasks" if word == "task source" else word)
