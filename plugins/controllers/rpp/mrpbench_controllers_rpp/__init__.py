"""Regulated pure pursuit with the parameters of Nav2, and its variant with a dynamic window; it runs in C++."""

from mrpbench_controllers_rpp.rpp import Rpp

__all__ = ["Rpp"]
