"""Robots as rigid bodies with driven wheels, by PyBullet."""

from mrpbench_simulators_pybullet.simulator import PyBullet

__all__ = ["PyBullet"]
