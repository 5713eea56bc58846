"""Environments in which policies learn: of PettingZoo (parallel), and of Gymnasium for fleets and batches of them.

All have one interface in three depths: `grid`, `timed` (turns and delays) and `full_stack` (bodies).
"""

from mrpbench_policies.env.episode import Task
from mrpbench_policies.env.full_stack import FullStack
from mrpbench_policies.env.gym import FleetEnv, FleetVectorEnv
from mrpbench_policies.env.parallel import FleetParallelEnv, parallel_env
from mrpbench_policies.env.scenes import RandomScenes, Scenes, StudyScenes
from mrpbench_policies.env.timed import Timed
from mrpbench_policies.env.world_model import Depth, Grid

__all__ = [
    "Depth",
    "FleetEnv",
    "FleetParallelEnv",
    "FleetVectorEnv",
    "FullStack",
    "Grid",
    "RandomScenes",
    "Scenes",
    "StudyScenes",
    "Task",
    "Timed",
    "parallel_env",
]
