"""What the controllers of Nav2 share here: they run in C++ for whole fleets, on a rolling costmap around each robot.

`recipe` has the options and reads Nav2 parameter files, `costmap` has the options of the costmap, `critics` the base of
critics, and `session` runs a fleet. No plugin by itself: `dwb`, `mppi`, `rpp` and `graceful` derive from it.
"""

from mrpbench_controllers_local.costmap import LocalCostmap
from mrpbench_controllers_local.critics import (
    Critic,
    CriticSession,
    NativeCritic,
    Trajectories,
    chosen,
    with_prediction,
)
from mrpbench_controllers_local.recipe import LocalController, limited
from mrpbench_controllers_local.session import LocalSession
from mrpbench_controllers_local.settings import RobotSettings

__all__ = [
    "Critic",
    "CriticSession",
    "LocalController",
    "LocalCostmap",
    "LocalSession",
    "NativeCritic",
    "RobotSettings",
    "Trajectories",
    "chosen",
    "limited",
    "with_prediction",
]
