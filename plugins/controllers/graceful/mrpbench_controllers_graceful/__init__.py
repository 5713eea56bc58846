"""The graceful controller with the parameters of Nav2; it runs in C++."""

from mrpbench_controllers_graceful.graceful import Graceful

__all__ = ["Graceful"]
