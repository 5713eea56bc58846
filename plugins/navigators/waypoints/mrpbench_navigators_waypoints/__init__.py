"""The navigator `waypoints`: how robots follow the released parts of their paths.

From the top down: `waypoints` has the options, and `session` is one control period. It asks `route_follower` how far
robots are, where they go next, and which are stuck (in C++, on `route_tables`), `controller_server` for commands,
`detours` for ways around, and `recovery_manager` for the `recoveries`.
"""

from mrpbench_navigators_waypoints.recoveries import BackUp, Clear, RotateToPath, Spin, Wait
from mrpbench_navigators_waypoints.waypoints import Waypoints

__all__ = ["BackUp", "Clear", "RotateToPath", "Spin", "Wait", "Waypoints"]
