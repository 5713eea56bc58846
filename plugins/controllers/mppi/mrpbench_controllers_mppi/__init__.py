"""Nav2's MPPI controller for whole fleets, in C++.

`mppi` has the options, `critic` is the contract of critics, and `nav2_critics` has those of Nav2.
"""

from mrpbench_controllers_local import CriticSession, LocalCostmap, Trajectories

from mrpbench_controllers_mppi.critic import MppiCritic
from mrpbench_controllers_mppi.mppi import Mppi
from mrpbench_controllers_mppi.nav2_critics import (
    ConstraintCritic,
    CostCritic,
    GoalAngleCritic,
    GoalCritic,
    ObstaclesCritic,
    PathAlignCritic,
    PathAngleCritic,
    PathFollowCritic,
    PredictedObstacleCritic,
    PreferForwardCritic,
    TwirlingCritic,
    VelocityDeadbandCritic,
)

__all__ = [
    "ConstraintCritic",
    "CostCritic",
    "CriticSession",
    "GoalAngleCritic",
    "GoalCritic",
    "LocalCostmap",
    "Mppi",
    "MppiCritic",
    "ObstaclesCritic",
    "PathAlignCritic",
    "PathAngleCritic",
    "PathFollowCritic",
    "PredictedObstacleCritic",
    "PreferForwardCritic",
    "Trajectories",
    "TwirlingCritic",
    "VelocityDeadbandCritic",
]
