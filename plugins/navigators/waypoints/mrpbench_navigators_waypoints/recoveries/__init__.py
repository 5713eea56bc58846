"""Recoveries of robots that are stuck, with the names and values of Nav2's behaviours."""

from mrpbench_navigators_waypoints.recoveries.back_up import BackUp
from mrpbench_navigators_waypoints.recoveries.clear import Clear
from mrpbench_navigators_waypoints.recoveries.spin import RotateToPath, Spin
from mrpbench_navigators_waypoints.recoveries.wait import Wait

__all__ = ["BackUp", "Clear", "RotateToPath", "Spin", "Wait"]
