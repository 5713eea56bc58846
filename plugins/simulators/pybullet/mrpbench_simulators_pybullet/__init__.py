"""Robots as rigid bodies with driven wheels, by PyBullet."""

from mrpbench_simulators_pybullet.above import occupancy_from_above
from mrpbench_simulators_pybullet.simulator import PyBullet

__all__ = ["PyBullet", "occupancy_from_above"]
