"""The simulator `kinematic`, which needs only NumPy: unicycles with limits, contacts of discs, lidars in closed form.

A robot is the disc of its circumscribed radius, which planners use and lidars see. Its speed follows the command as
fast as its limits allow; in each sub-step it drives exactly the arc of its mean speeds.
"""

import math
from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from mrpbench_core.api import Simulation, Simulator
from mrpbench_core.builtin.simulators.contacts import Discs
from mrpbench_core.builtin.simulators.lidar import scan
from mrpbench_core.builtin.simulators.nearby import Nearby
from mrpbench_core.model.common.arrays import Float, Int16, Int32
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.common.poses import wrapped
from mrpbench_core.model.execution.movers import JUMP, MoverDiscs
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.scan_schedule import ScanSchedule
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.level_layout import LevelLayout
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Kinematic(Simulator):
    """Simulates unicycles and discs in the plane, in which levels lie side by side, with doors and lifts."""

    def open(
        self,
        world: World,
        fleet: Fleet,
        placements: Float,
        seed: int,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> Simulation:
        """Place the robots; nothing here is random."""
        del seed
        return _Plane(world, fleet, placements, period, movers, levels)


class _Plane(Simulation):
    def __init__(
        self,
        world: World,
        fleet: Fleet,
        placements: Float,
        period: float,
        movers: Sequence[float],
        levels: Int16 | None,
    ) -> None:
        robots = fleet.robots
        self._robot_radii = fleet.radii
        self._radii = np.concatenate([fleet.radii, np.asarray(movers, float)])
        self._limit = np.array([(robot.max_speed, robot.max_turn_rate) for robot in robots])
        self._acceleration = np.array([(robot.acceleration, robot.turn_acceleration) for robot in robots])
        # In a sub-step nothing moves farther than a quarter of the smallest radius: nothing passes through anything.
        stride = float(self._radii.min(initial=1.0)) / 4
        self._stride, self._reach = stride, period * float(self._limit[:, 0].max(initial=0.0))
        self._period, self._periods = period, 0
        self._schedule = ScanSchedule(fleet, period)
        reach = {lidar: lidar.range + math.hypot(*lidar.mount[:2]) for lidar in self._schedule.lidars}
        self._layout = LevelLayout(world, max(reach.values(), default=0.0))
        self._discs = Discs(self._radii, len(robots), self._layout.segments, stride)
        self._visible = {lidar: Nearby(self._layout.segments, far) for lidar, far in reach.items()}
        self._facilities = Facilities(world)
        self._doing = self._facilities.initial_state()
        self._leaves = self._layout.door_outlines(self._facilities, self._doing)
        self._movers = MoverDiscs(self._layout, np.asarray(movers, float))
        self._level: Int16 = np.zeros(len(robots), np.int16) if levels is None else np.array(levels, np.int16)
        self._pose = self._layout.to_plane(np.array(placements, float).reshape(-1, 3), self._level)
        self._twist = np.zeros((len(robots), 2))
        self._scans = self._take_scans()
        self._state = self._observe(np.empty((0, 2), np.int32))

    @property
    def state(self) -> State:
        return self._state

    def step(self, inputs: Inputs) -> State:
        command = np.clip(inputs.twist, -self._limit, self._limit)
        begin = self._movers.body
        self._movers.update(inputs)
        end = self._movers.body
        with np.errstate(invalid="ignore"):  # what was nowhere
            shift = end - begin
            way = np.hypot(*shift.T)
        begin, shift = np.where((way <= JUMP)[:, None], (begin, shift), (end, np.zeros_like(shift)))
        self._operate(inputs.facilities)
        contacts: set[tuple[int, int]] = set()
        farthest = max(self._reach, float(way.max(initial=0.0, where=way <= JUMP)))
        substeps = max(1, math.ceil(farthest / self._stride))
        for substep in range(1, substeps + 1):
            movers = end if substep == substeps else begin + shift * (substep / substeps)
            contacts |= self._advance(command, movers, self._period / substeps)
        self._periods += 1
        self._scans += self._take_scans()
        self._state = self._observe(np.array(sorted(contacts), np.int32))
        return self._state

    def _observe(self, contacts: Int32) -> State:
        pose = self._layout.to_levels(self._pose, self._level)
        return State(pose=pose, twist=self._twist, level=self._level, contacts=contacts, facilities=self._doing)

    def _operate(self, commands: Mapping[str, float]) -> None:
        """Move doors and lifts, and the robots in lifts."""
        before, pose = self._doing, self._state.pose
        after = self._facilities.advance(
            before, commands, self._period, *self._movers.among(pose, self._level, self._robot_radii)
        )
        if after == before:
            return
        self._doing = after
        self._level = self._facilities.carry(before, after, pose, self._level)
        self._pose = self._layout.to_plane(pose, self._level)
        self._leaves = self._layout.door_outlines(self._facilities, after)

    def _advance(self, command: Float, movers: Float, dt: float) -> set[tuple[int, int]]:
        change = command - self._twist
        reached = np.clip(change, -self._acceleration * dt, self._acceleration * dt)
        # Mean over dt of a speed that changes at full acceleration until it is reached, and then stays.
        mean = self._twist + reached - reached * np.abs(reached) / (2 * self._acceleration * dt)
        speed, turn = mean[:, 0], mean[:, 1] * dt
        heading = self._pose[:, 2] + turn / 2
        chord = speed * dt * np.sinc(turn / (2 * np.pi))
        direction = np.stack([np.cos(heading), np.sin(heading)], axis=1)
        before = np.concatenate([self._pose[:, :2], movers])
        free = np.concatenate([self._pose[:, :2] + direction * chord[:, None], movers])
        after, contacts = self._discs.separate(before, free, self._leaves)
        self._twist = self._twist + reached
        for robot in np.flatnonzero((after != free).any(axis=1)).tolist():
            if robot < len(self._twist):  # what was pushed is as fast as it really went
                self._twist[robot, 0] = ((after[robot] - before[robot]) * direction[robot]).sum() / dt
        yaw = wrapped(self._pose[:, 2] + turn)
        self._pose = np.column_stack([after[: len(yaw)], yaw])
        return contacts

    def scans(self) -> tuple[ScanBatch, ...]:
        taken, self._scans = self._scans, ()
        return taken

    def _take_scans(self) -> tuple[ScanBatch, ...]:
        """Scans due now."""
        stamp = self._periods * self._period
        return tuple(
            ScanBatch(stamp=stamp, robot=robots, ranges=np.array([self._scan(lidar, robot) for robot in robots]))
            for lidar, robots in self._schedule.due(self._periods)
        )

    def _scan(self, lidar: Lidar, robot: int) -> Float:
        pose = self._pose[robot]
        others = np.concatenate([np.delete(self._pose[:, :2], robot, axis=0), self._movers.scan_discs])
        visible = self._visible[lidar](pose[0], pose[1])
        if len(self._leaves):
            visible = np.concatenate([visible, self._leaves])
        radii = np.concatenate([np.delete(self._robot_radii, robot), self._movers.scan_radius])
        return scan(lidar, pose, visible, others, radii)

    def close(self) -> None:
        """Nothing is held."""
