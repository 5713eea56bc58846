"""LastCritic: keep to one side of the path."""

import attrs
import numpy as np
from mrpbench_controllers_dwb import Critic, CriticSession, Trajectories
from mrpbench_core.api import option
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class LastCritic(Critic):
    """Scores how far a trajectory ends from a line beside the path."""

    offset: float = option(0.2, help="distance of that line to the right of the path; negative: to the left", unit="m")

    def start(self, robot: RobotModel, world: World) -> CriticSession:  # noqa: ARG002
        """Begin to score for one robot."""
        return LastCriticSession(self.offset)


class LastCriticSession(CriticSession):
    """Scores the trajectories of one robot."""

    def __init__(self, offset: float) -> None:
        self.offset = offset

    def score(self, trajectories: Trajectories) -> Float:
        """Return the distance of each end from the line, in metres."""
        ends, path = trajectories.pose[:, -1, :2], trajectories.path
        along = path[min(1, len(path) - 1)] - path[0]
        length = np.hypot(*along)
        if length == 0:
            return np.zeros(len(ends))
        left = (along[0] * (ends[:, 1] - path[0, 1]) - along[1] * (ends[:, 0] - path[0, 0])) / length
        gap: Float = np.abs(left + self.offset)
        return gap
