"""A world of rigid bodies in motion, by any physics engine."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from mrpbench_core.api import Simulation
from mrpbench_core.model.common.arrays import Float, Int16, Int32
from mrpbench_core.model.common.fleet import Fleet, Lidar
from mrpbench_core.model.execution.movers import MoverDiscs
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.scan_schedule import ScanSchedule
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.model.worlds.level_layout import LevelLayout
from mrpbench_core.model.worlds.world import World
from mrpbench_simulators_bodies.drives import Drive, Plane, Wheels
from mrpbench_simulators_bodies.engine import Engine
from mrpbench_simulators_bodies.leaves import leaf_poses
from mrpbench_simulators_bodies.lidar import Casters
from mrpbench_simulators_bodies.scene import Scene, build_scene


class BodySimulation(Simulation):
    """Robots, walls and movers; arguments as in `Simulator.open`.

    Args:
        start: builds the engine of a scene.
        timestep: of a physics step in seconds, shortened so that steps fill a control period.
        planar: as in `Scene`.
    """

    def __init__(
        self,
        start: Callable[[Scene], Engine],
        timestep: float,
        planar: bool,
        world: World,
        fleet: Fleet,
        placements: Float,
        period: float,
        movers: Sequence[float] = (),
        levels: Int16 | None = None,
    ) -> None:
        self._radius, self._period, self._periods = fleet.radii, period, 0
        self._substeps = max(1, round(period / timestep))
        self._timestep = period / self._substeps
        self._schedule = ScanSchedule(fleet, period)
        reach = max((lidar.range + math.hypot(*lidar.mount[:2]) for lidar in self._schedule.lidars), default=0.0)
        self._layout, self._facilities = LevelLayout(world, reach), Facilities(world)
        self._doing = self._facilities.initial_state()
        self._outlines = self._layout.door_outlines(self._facilities, self._doing)
        self._level: Int16 = np.zeros(len(fleet), np.int16) if levels is None else np.array(levels, np.int16)
        self._limit = np.array([(robot.max_speed, robot.max_turn_rate) for robot in fleet.robots]).reshape(-1, 2)
        self._discs = MoverDiscs(self._layout, np.asarray(movers, float))
        poses = self._layout.to_plane(np.asarray(placements, float).reshape(-1, 3), self._level)
        self.scene = build_scene(
            world, self._layout, self._facilities, self._doing, fleet, poses, movers, self._timestep, planar
        )
        self.engine = start(self.scene)
        self.engine.place_leaves(leaf_poses(self._facilities, self._layout, self._doing))
        self._drive: Drive = Plane(self.engine, self.scene, period) if planar else Wheels(self.engine, self.scene)
        self._casters = Casters(self._schedule.lidars, self._layout.segments, self.scene.bodies, self._radius)
        self._state = self._observe({})
        self._scans = self._take_scans()

    @property
    def state(self) -> State:
        """The true state now."""
        return self._state

    def step(self, inputs: Inputs) -> State:
        """Advance by one control period."""
        if inputs.facilities:
            self._operate(inputs.facilities)
        self._discs.update(inputs)
        self.engine.prepare(self._plane[:, :2])
        self._drive.command(np.minimum(np.maximum(inputs.twist, -self._limit), self._limit))
        forces: dict[tuple[int, int], float] = {}
        for substep in range(1, self._substeps + 1):
            self._drive.before_step()
            if inputs.movers is not None:
                before = (self._substeps - substep) * self._timestep
                self.engine.place_movers(self._discs.body - inputs.movers[:, 2:] * before)
            self.engine.advance()
            for pair, force in self.engine.contacts().items():
                forces[pair] = forces.get(pair, 0.0) + force / self._substeps
        self._periods += 1
        self._state = self._observe(forces)
        self._scans += self._take_scans()
        return self._state

    def _operate(self, commands: Mapping[str, float]) -> None:
        """Move doors and lifts, and the robots in lifts."""
        before, pose, level = self._doing, self._state.pose, self._level
        after = self._facilities.advance(before, commands, self._period, *self._discs.among(pose, level, self._radius))
        if after == before:
            return
        self._doing, self._level = after, self._facilities.carry(before, after, pose, level)
        self.engine.place_leaves(leaf_poses(self._facilities, self._layout, after))
        self._outlines = self._layout.door_outlines(self._facilities, after)
        spread = self._layout.to_plane(pose, self._level)
        for robot in np.flatnonzero(self._level != level).tolist():
            self._drive.place(robot, *spread[robot, :2].tolist())

    def _observe(self, forces: Mapping[tuple[int, int], float]) -> State:
        self._plane, twist = self._drive.observe()
        pairs = sorted(forces)
        return State(
            pose=self._layout.to_levels(self._plane, self._level),
            twist=twist,
            level=self._level,
            contacts=np.array(pairs, np.int32),
            contact_force=np.array([forces[pair] for pair in pairs]),
            facilities=self._doing,
        )

    def scans(self) -> tuple[ScanBatch, ...]:
        """Scans taken since the last call."""
        taken, self._scans = self._scans, ()
        return taken

    def _take_scans(self) -> tuple[ScanBatch, ...]:
        stamp = self._periods * self._period
        return tuple(
            ScanBatch(stamp=stamp, robot=robots, ranges=self.scan(lidar, robots))
            for lidar, robots in self._schedule.due(self._periods)
        )

    def scan(self, lidar: Lidar, robots: Int32) -> Float:
        """Ranges f8[k,beams] of `robots` now; inf = no return."""
        discs = self._discs
        return self._casters.scan(lidar, robots, self._plane, discs.scan_discs, discs.scan_radius, self._outlines)

    def close(self) -> None:
        """Close the physics world."""
        self.engine.close()
