"""Simultaneous localisation and mapping, in C++."""

from mrpbench_localizers_slam.localizer import Slam

__all__ = ["Slam"]
