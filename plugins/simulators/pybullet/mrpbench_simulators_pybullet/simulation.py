"""A PyBullet world in motion whose lidars are ray tests."""

from typing import Any

from mrpbench_simulators_bodies.simulation import BodySimulation

from mrpbench_core.model.common.arrays import Float, Int32
from mrpbench_core.model.common.fleet import Lidar
from mrpbench_simulators_pybullet.bullet import quiet
from mrpbench_simulators_pybullet.engine import BulletEngine
from mrpbench_simulators_pybullet.rays import RayTests


class RayTestSimulation(BodySimulation):
    """As its base, but for the lidars."""

    _rays: RayTests | None = None

    def scan(self, lidar: Lidar, robots: Int32) -> Float:
        """Ranges f8[k,beams] of `robots` now; inf = no return."""
        if self._rays is None:
            engine: Any = self.engine
            assert isinstance(engine, BulletEngine)
            with quiet():
                self._rays = RayTests(engine.bullet, self._casters.outlines)
        return self._rays.scan(lidar, robots, self._plane, self._discs)
