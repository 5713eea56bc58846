"""Steps the native simulation of robots and lidars in the plane."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from mrpbench_native.sim import Caster, Plane

from mrpbench_core.api import Simulation
from mrpbench_core.model.common.arrays import Float, Int16, Int32, frozen_array, read_only
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.movers import MoverDiscs
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.scan_schedule import ScanSchedule
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.level_layout import LevelLayout
from mrpbench_core.model.worlds.world import World

_NO_CONTACTS = frozen_array(np.empty((0, 2)), "i4", 2)


class WheelNoise(NamedTuple):
    """The deviation of motion from the commands; draws are functions of the seed, the robot's index and the period."""

    options: dict[str, Any]
    """As `mrpbench_native.sim.noise_options` describes them."""
    seed: int


class PlanarSimulation(Simulation):
    """Robots, walls and movers; arguments as in `Simulator.open`. A robot is the disc of its circumscribed radius.

    `threads` share the lidars.
    """

    def __init__(
        self,
        noise: WheelNoise,
        world: World,
        fleet: Fleet,
        placements: Float,
        period: float,
        movers: Sequence[float],
        levels: Int16 | None,
        *,
        threads: int = 1,
    ) -> None:
        robots = fleet.robots
        self._schedule = ScanSchedule(fleet, period)
        reach = max((lidar.range + math.hypot(*lidar.mount[:2]) for lidar in self._schedule.lidars), default=0.0)
        self._layout, self._facilities = LevelLayout(world, reach), Facilities(world)
        self._doing = self._facilities.initial_state()
        self._leaves = self._layout.door_outlines(self._facilities, self._doing)
        self._level: Int16 = frozen_array(np.zeros(len(robots)) if levels is None else levels, "i2")
        solids = self._layout.segments
        self._robot_radius = fleet.radii
        self._plane = Plane(
            segments=solids,
            robots={
                "pose": self._layout.to_plane(np.array(placements, float).reshape(-1, 3), self._level),
                "radius": fleet.radii,
                "limit": _table([(robot.max_speed, robot.max_turn_rate) for robot in robots]),
                "acceleration": _table([(robot.acceleration, robot.turn_acceleration) for robot in robots]),
                "wheel_separation": np.array([robot.wheel_separation for robot in robots], float),
            },
            movers=np.array(movers, float),
            period=period,
            noise=noise.options,
            seed=noise.seed % 2**64,
        )
        self._plane.set_leaves(self._leaves)
        self._period, self._periods = period, 0
        self._casters = {
            lidar: Caster(segments=solids, lidar=lidar, threads=threads) for lidar in self._schedule.lidars
        }
        self._movers = MoverDiscs(self._layout, np.asarray(movers, float))
        self._state = self._observe()
        self._scans: tuple[ScanBatch, ...] = ()
        self._casting: Caster | None = None
        """Takes scans that are not complete yet."""
        self._take_scans(self._schedule.due(0))

    @property
    def state(self) -> State:
        """The true state now."""
        return self._state

    def step(self, inputs: Inputs) -> State:
        """Advance by one control period."""
        self._complete_scans()
        self._movers.update(inputs)
        if inputs.facilities:
            self._operate(inputs.facilities)
        self._plane.step(inputs.twist, np.ascontiguousarray(self._movers.body))
        self._periods += 1
        self._state = self._observe()
        if due := self._schedule.due(self._periods):
            self._take_scans(due)
        return self._state

    def _observe(self) -> State:
        robots = len(self._level)
        pose, twist = np.empty((robots, 3)), np.empty((robots, 2))
        contacts = self._plane.contacts if self._plane.observe(pose, twist) else _NO_CONTACTS
        self._pose = read_only(pose)
        pose = self._layout.to_levels(pose, self._level)
        return State(pose=pose, twist=read_only(twist), level=self._level, contacts=contacts, facilities=self._doing)

    def _operate(self, commands: Mapping[str, float]) -> None:
        """Move doors and lifts, and the robots in lifts."""
        before, pose, level = self._doing, self._state.pose, self._level
        after = self._facilities.advance(
            before, commands, self._period, *self._movers.among(pose, level, self._robot_radius)
        )
        if after == before:
            return
        self._doing = after
        self._level = frozen_array(self._facilities.carry(before, after, pose, level), "i2")
        self._leaves = self._layout.door_outlines(self._facilities, after)
        self._plane.set_leaves(self._leaves)
        spread = self._layout.to_plane(pose, self._level)
        for robot in np.flatnonzero(self._level != level).tolist():
            self._plane.place(robot, *spread[robot, :2].tolist())

    def scans(self) -> tuple[ScanBatch, ...]:
        """Scans taken since the last call."""
        self._complete_scans()
        taken, self._scans = self._scans, ()
        return taken

    def _take_scans(self, due: Sequence[tuple[Lidar, Int32]]) -> None:
        """Begin with the scans of the robots whose turn it is now, by lidar; other threads go on with them."""
        stamp = self._periods * self._period
        radius, discs = self._robot_radius, np.ascontiguousarray(self._movers.scan_discs)
        if len(discs):
            radius = np.concatenate([radius, self._movers.scan_radius])
        for lidar, robots in due:
            self._complete_scans()
            self._casting, ranges = self._casters[lidar], np.empty((len(robots), lidar.beams))
            self._casting.begin(ranges, robots, self._pose, discs, radius, self._leaves)
            self._scans += (ScanBatch(stamp=stamp, robot=robots, ranges=read_only(ranges)),)

    def _complete_scans(self) -> None:
        if self._casting is not None:
            self._casting.finish()
            self._casting = None

    def close(self) -> None:
        """Nothing is held."""


def _table(rows: list[tuple[float, float]]) -> Float:
    return np.array(rows, float).reshape(-1, 2)
