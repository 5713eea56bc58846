"""Nav2's DWB controller on a rolling costmap, for whole fleets, in C++."""

from mrpbench_controllers_dwb.costmap import LocalCostmap
from mrpbench_controllers_dwb.critic import Critic, CriticSession, Trajectories
from mrpbench_controllers_dwb.critics import (
    BaseObstacle,
    GoalAlign,
    GoalDist,
    ObstacleFootprint,
    Oscillation,
    PathAlign,
    PathDist,
    PreferForward,
    RotateToGoal,
    Twirling,
)
from mrpbench_controllers_dwb.dwb import Dwb

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
    "PreferForward",
    "RotateToGoal",
    "Trajectories",
    "Twirling",
]
