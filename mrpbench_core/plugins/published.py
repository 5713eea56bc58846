"""The names that the distributions of this project offer, for errors; a test compares them with the entry points."""

from mrpbench_core.files.extras import pip
from mrpbench_core.plugins.kinds import COMMANDS

_CRITICS = (
    *("RotateToGoal", "Oscillation", "BaseObstacle", "ObstacleFootprint", "GoalAlign"),
    *("PathAlign", "PathDist", "GoalDist", "PredictedObstacle", "PreferForward", "Twirling"),
)
_MPPI_CRITICS = (
    *("ConstraintCritic", "CostCritic", "GoalAngleCritic", "GoalCritic", "ObstaclesCritic", "PathAlignCritic"),
    *("PathAngleCritic", "PathFollowCritic", "PredictedObstacleCritic", "PreferForwardCritic"),
    *("TwirlingCritic", "VelocityDeadbandCritic"),
)
_METRICS = (
    *("planning", "execution", "barn", "clearance", "contact", "deadlock", "delay", "draws", "efficiency"),
    *(
        "energy",
        "fairness",
        "localization",
        "people",
        "smoothness",
        "stops",
        "tasks",
        "throughput",
        "tracking",
        "waiting",
    ),
)
_PLANNERS = (
    *("astar", "prioritized", "cbs", "ecbs", "eecbs", "cbs_ta", "ita_cbs", "ecbs_ta", "ita_ecbs"),
    *("pbs", "pibt", "lacam", "lns", "token_passing", "example", "external", "rolling_horizon"),
)
_WORLDS = (
    *("rmf", "movingai", "ros_map", "barn", "dynabarn", "office", "warehouse", "airport", "household", "hospital"),
    *("bottlenecks", "encounters", "station", "office_noon", "hospital_corridor", "warehouse_pickers"),
    *("generated_warehouse", "generated_rooms", "generated_field", "generated_random"),
)
PUBLISHED: dict[str, dict[str, tuple[str, ...]]] = {
    "mrpbench-standard": {
        "mrpbench.assigners": ("greedy", "hungarian", "insertion", "token_passing"),
        "mrpbench.controllers": ("dwb", "global_planner", "graceful", "mppi", "pure_pursuit", "rotation_shim", "rpp"),
        "mrpbench.critics": _CRITICS,
        "mrpbench.crowds": ("carts", "dynabarn", "orca", "scripted", "social_force"),
        "mrpbench.dispatchers": ("btpg", "gses", "sadg"),
        "mrpbench.localizers": ("amcl", "slam"),
        "mrpbench.metrics": _METRICS,
        "mrpbench.mppi_critics": _MPPI_CRITICS,
        "mrpbench.navigators": ("waypoints",),
        "mrpbench.planners": _PLANNERS,
        "mrpbench.predictors": ("constant_velocity", "social_force"),
        "mrpbench.recoveries": ("back_up", "clear", "rotate_to_path", "spin", "wait"),
        "mrpbench.scenarios": ("barn", "movingai"),
        "mrpbench.simulators": ("planar",),
        "mrpbench.task_sources": ("charging",),
        "mrpbench.worlds": _WORLDS,
    },
    "mrpbench-analysis": {"mrpbench.commands": ("analyze", "calibrate", "compare")},
    "mrpbench-publish": {"mrpbench.commands": ("publish", "site", "verify")},
    "mrpbench-replay": {"mrpbench.commands": ("view",)},
    "mrpbench-scaffold": {"mrpbench.commands": ("demo", "init", "new-plugin")},
    "mrpbench-world": {"mrpbench.commands": ("world",)},
    "mrpbench-search": {"mrpbench.commands": ("choose", "evidence", "hunt", "saturate", "size", "tune")},
    "mrpbench-assigners-ortools": {"mrpbench.assigners": ("ortools_mip", "ortools_sat")},
    "mrpbench-bridges-ros2": {"mrpbench.navigators": ("ros2",), "mrpbench.hooks": ("ros2",)},
    "mrpbench-executors-dask": {"mrpbench.executors": ("dask",)},
    "mrpbench-exporters-rosbag2": {"mrpbench.formats": ("rosbag2",)},
    "mrpbench-league": {
        "mrpbench.commands": ("league-run", "league-score"),
        "mrpbench.planners": ("league",),
        "mrpbench.scenarios": ("lorr",),
        "mrpbench.simulators": ("league",),
        "mrpbench.task_sources": ("lorr",),
    },
    "mrpbench-live": {
        "mrpbench.commands": ("check-vda5050", "control", "load", "serve"),
        "mrpbench.dispatchers": ("live", "rmf"),
        "mrpbench.interfaces": ("rmf", "vda5050"),
        "mrpbench.navigators": ("rmf", "vda5050"),
        "mrpbench.planners": ("live", "rmf"),
        "mrpbench.simulators": ("rmf", "vda5050"),
        "mrpbench.task_sources": ("live", "vda5050"),
    },
    "mrpbench-policies": {
        "mrpbench.metrics": ("pogema", "policy"),
        "mrpbench.planners": ("policy",),
        "mrpbench.scenarios": ("pogema",),
        "mrpbench.worlds": ("pogema",),
    },
    "mrpbench-simulators-mujoco": {"mrpbench.simulators": ("mujoco",)},
    "mrpbench-simulators-pybullet": {"mrpbench.simulators": ("pybullet",)},
}
"""Names by entry-point group, by distribution. Of other distributions nothing is known before they are installed."""

EXTRAS = {
    "mrpbench-standard": "",
    "mrpbench-analysis": "",
    "mrpbench-league": "",
    "mrpbench-publish": "",
    "mrpbench-replay": "",
    "mrpbench-scaffold": "",
    "mrpbench-world": "",
    "mrpbench-assigners-ortools": "ortools",
    "mrpbench-bridges-ros2": "ros2",
    "mrpbench-executors-dask": "dask",
    "mrpbench-exporters-rosbag2": "rosbag2",
    "mrpbench-live": "vda5050",
    "mrpbench-policies": "policies",
    "mrpbench-search": "search",
    "mrpbench-simulators-mujoco": "mujoco",
    "mrpbench-simulators-pybullet": "pybullet",
}
"""The extra of the distribution `mrpbench` that installs each; empty: `mrpbench` alone does."""


def remedy(name: str, group: str | None = None) -> str | None:
    """Return which distribution of this project has a plugin or command and how to install it.

    Args:
        name: the plugin or command.
        group: its entry-point group; without one, plugins of all kinds.
    """
    for owner, offers in PUBLISHED.items():
        groups = [group] if group else [offered for offered in offers if offered != COMMANDS]
        if any(name in offers.get(offered, ()) for offered in groups):
            return f"{owner} has it: {pip(EXTRAS[owner])}"
    return None
