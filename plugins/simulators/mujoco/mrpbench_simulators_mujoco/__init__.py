"""Robots as rigid bodies with driven wheels, by MuJoCo."""

from mrpbench_simulators_mujoco.simulator import MuJoCo

__all__ = ["MuJoCo"]
