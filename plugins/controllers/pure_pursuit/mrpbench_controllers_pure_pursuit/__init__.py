"""Regulated pure pursuit for differential drive."""

from mrpbench_controllers_pure_pursuit.pure_pursuit import PurePursuit

__all__ = ["PurePursuit"]
