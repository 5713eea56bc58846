"""Nav2's rotation shim: turns a robot to a new path before another controller drives it."""

from mrpbench_controllers_rotation_shim.rotation_shim import RotationShim

__all__ = ["RotationShim"]
