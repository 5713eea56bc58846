"""The messages (`nav_msgs/Path`) with the trajectories that controllers chose."""

from functools import cache

import numpy as np

from mrpbench_core.model.common.arrays import Float, Int
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.worlds.world import World
from mrpbench_exporters_rosbag2.messages import Topic, header, message, pose, spatial
from mrpbench_exporters_rosbag2.source import POSE, Rows, TopicSource
from mrpbench_exporters_rosbag2.template import STAMP, Template


def local_plan(robot: int, name: str, world: World) -> TopicSource:
    """The trajectories that one robot's controller chose, by Nav2's name of the topic."""
    heights = np.array([level.elevation for level in world.levels])

    def rows(block: Chunk) -> Rows | None:
        if "trajectory_pose" not in block:
            return None
        chosen = (block["trajectory_robot"] == robot) & (block["trajectory_chosen"] == 1)
        times, planar = block["trajectory_time"][chosen], block["trajectory_pose"][chosen].astype(float)
        height = np.zeros(len(times))
        if "level" in block:
            sample = np.searchsorted(block["time"], times, side="right") - 1
            height = heights[block["level"][sample.clip(0), robot]]
        return times, {"pose": spatial(planar, height[:, None])}

    return TopicSource(Topic(f"/{name}/local_plan", "nav_msgs/Path"), _Paths(), rows)


class _Paths:
    """Makes paths of as many poses as are recorded; the stamp of each pose is that of the command."""

    def fill(self, stamps: Int, **values: Float) -> list[bytes]:
        """One path for each of `stamps`; `pose` f8[k,p,7]."""
        return _template(values["pose"].shape[1]).fill(stamps, **values)


@cache
def _template(poses: int) -> Template:
    stamped = message("geometry_msgs/PoseStamped", header=header(STAMP, "map"), pose=pose(POSE))
    path = message("nav_msgs/Path", header=header(STAMP, "map"), poses=[stamped] * poses)
    return Template("nav_msgs/Path", path, {"pose": POSE})
