"""Nav2's DWB controller on a rolling costmap, for whole fleets, in C++.

`dwb` has the options, `critic` is the contract of critics, and `nav2_critics` has those of Nav2.
"""

from mrpbench_controllers_local import LocalCostmap

from mrpbench_controllers_dwb.critic import Critic, CriticSession, Trajectories
from mrpbench_controllers_dwb.dwb import Dwb
from mrpbench_controllers_dwb.nav2_critics import (
    BaseObstacle,
    GoalAlign,
    GoalDist,
    ObstacleFootprint,
    Oscillation,
    PathAlign,
    PathDist,
    PredictedObstacle,
    PreferForward,
    RotateToGoal,
    Twirling,
)

__all__ = [
    "BaseObstacle",
    "Critic",
    "CriticSession",
    "Dwb",
    "GoalAlign",
    "GoalDist",
    "LocalCostmap",
    "ObstacleFootprint",
    "Oscillation",
    "PathAlign",
    "PathDist",
    "PredictedObstacle",
    "PreferForward",
    "RotateToGoal",
    "Trajectories",
    "Twirling",
]
