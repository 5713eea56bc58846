"""A global planner: plans each robot's path on a costmap of what its lidar has seen, for another controller."""

from mrpbench_controllers_global_planner.global_planner import GlobalPlanner

__all__ = ["GlobalPlanner"]
