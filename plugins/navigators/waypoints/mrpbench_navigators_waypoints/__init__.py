"""The navigator `waypoints`: how robots follow the released parts of their paths.

From the top down: `waypoints` has the options, and `session` is one control period. It asks `route_follower` how far
robots are (`route_progress` counts on `route_tables`, `route_checks` are the conditions), `controller_server` for
commands, `progress_checker` which robots are stuck, `detours` for ways around, and `recovery_manager` for the
`recoveries`.
"""

from mrpbench_navigators_waypoints.recoveries import BackUp, Clear, Spin, Wait
from mrpbench_navigators_waypoints.waypoints import Waypoints

__all__ = ["BackUp", "Clear", "Spin", "Wait", "Waypoints"]
