"""The channels of a recording, which say what happened during a run.

| channel | per sample | meaning |
|---|---|---|
| `time` | f8 | simulated seconds of the periodic channels below |
| `truth` | f8[n,3] | true x, y, yaw in `map` |
| `truth_twist` | f8[n,2] | true m/s, rad/s |
| `estimate` | f8[n,3] | localizer's x, y, yaw in `map` |
| `odometry` | f8[n,5] | x, y, yaw in the odometry frame, m/s, rad/s |
| `command` | f8[n,2] | commanded m/s, rad/s |
| `level` | i2[n] | index into `World.levels` |
| `released`, `reached`, `cleared` | i4[n] | path segments |
| `speed_limit` | f8[n] | m/s that the dispatcher allows each robot, inf = any; only where it limits speeds |
| `mode` | u1[n] | `Mode` |
| `waits_for` | i4[n] | index into `Roadmap.resources` of what each robot has asked for and may not use yet, -1 = none |
| `facility` | f8[F] | what doors and lifts do, in the order of `Facilities.names`; only where there are some |
| `mover` | f8[m,5] | true x, y, yaw in `map` and velocity x, y of each mover; only where there are some |
| `mover_level` | i2[m] | index into `World.levels`, -1 = absent; with `mover` |
| `mover_arrivals` | i4[m] | number of goals that each mover has reached, -1 = has none; with `mover` |
| `contact_time`, `contact` | f8; i4[2] | per pair and period in contact: robot; robot, -1 = wall or n + j = mover j |
| `contact_force` | f8 | of each contact: mean normal force over the period in newtons, NaN = unknown |
| `scan_time`, `scan_robot`, `scan_ranges` | f8; i4; f4[beams] | only with `recording.scans` |
| `map_time`, `map_robot` | f8; i4 | per tile of a robot's map that changed; only where the localizer builds maps |
| `map_corner`, `map_side`, `map_cells` | f8[2]; f8; i1[r,c] | see `LocalizerSession.map_changes` |
| `trajectory_time`, `trajectory_robot` | f8; i4 | per trajectory; only with `recording.trajectories` |
| `trajectory_chosen`, `trajectory_cost` | u1; f8 | 1 = the chosen one; lower is better, inf = refused, NaN = unknown |
| `trajectory_pose` | f4[16,3] | x, y, yaw in `map`, in order of time |
| `critic_time`, `critic_robot` | f8; i4 | per critic and chosen trajectory; only with `recording.trajectories` |
| `critic_name`, `critic_score` | U; f8 | what the critic adds to the cost of the chosen trajectory |
| `route_time`, `route_revision`, `route_robot` | f8; i4; i4 | one row per new waypoint of each plan after the first |
| `route_segment` | i4 | segments of the robot before this waypoint, from the beginning of the execution |
| `route_waypoint`, `route_level`, `route_speed` | f8[3]; i2; f8 | see `mrpbench_core.model.runs.routes.RouteHistory` |
| `route_edge`, `route_leave` | i4; i8 | of the segment to the waypoint: edge, -1 = wait; tick at which it ends |
| `errand_time`, `errand_task` | f8; i4 | per place of each errand: release and index of its task; only with `tasks` |
| `errand_number` | i4 | the errand of the task, from 0, which is done at any of its places |
| `errand_goal`, `errand_level` | f8[3]; i2 | see `mrpbench_core.model.planning.scenario.Task` |
| `errand_service`, `errand_deadline`, `errand_priority` | f8; f8; i4 | the same |
| `task_time`, `task_index`, `task_event` | f8; i4; U | see `TASK_EVENTS`; only with `tasks` |
| `task_robot`, `task_errand` | i4; i4 | -1 = none |
| `draw` | i4 | number of each draw of the delays, from 0 = this execution; only with `delays.draws` |
| `draw_arrival` | f8[n] | per draw: simulated seconds at which each robot completed its last move, NaN = never |
| `draw_waiting` | f8[n] | per draw: seconds in which each robot had made all that was released, and had not arrived |
| `event_time`, `event_kind`, `event_robot`, `event_detail` | f8; U; i4; U | see `Event` |

Periodic channels are sampled every `1 / recording.rate` seconds, and at the start and the end of the execution.
"""

from collections.abc import Container, Mapping
from typing import Any

from numpy.typing import NDArray

Chunk = Mapping[str, NDArray[Any]]
"""Consecutive rows of some channels, by channel name."""

PERIODIC = (
    "truth",
    "truth_twist",
    "estimate",
    "odometry",
    "command",
    "level",
    "released",
    "reached",
    "cleared",
    "mode",
    "waits_for",
)
"""Channels that share the time axis `time`."""

POSES = ("truth", "estimate")
"""Channels of poses, the first of which is shown and judged where both were recorded."""

TASK_EVENTS = ("released", "refused", "assigned", "withdrawn", "begun", "errand", "done", "given_up")
"""What happens to a task: it is released, refused (no robot can do it), given to a robot and taken back, begun (a robot
rests at its first errand), an errand of it is done, all are, or it is given up because its robot stopped."""


def pose_channel(channels: Container[str]) -> str | None:
    """Return the name of the best channel of poses among those that were recorded, None if there is none."""
    return next((name for name in POSES if name in channels), None)
