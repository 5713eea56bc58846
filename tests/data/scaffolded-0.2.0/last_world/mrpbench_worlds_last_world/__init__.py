"""World last_world for mrpbench."""

from mrpbench_worlds_last_world.last_world import LastWorld

__all__ = ["LastWorld"]
