"""Estimated poses for Open-RMF: `/fleet_states`, as fleet drivers publish it."""

import numpy as np

from mrpbench_core.model.execution.motion import Mode
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.messages import Topic, time
from mrpbench_exporters_rosbag2.rmf import ADAPTER_ERROR, IDLE, MOVING, WAITING, Release, rmf_message, rmf_types
from mrpbench_exporters_rosbag2.source import Rows, Throttle, TopicSource, Varying
from mrpbench_exporters_rosbag2.template import STAMP, Template, hole

FLEET = "mrpbench"
"""Its name."""
INTERVAL = 0.5
"""seconds between two messages, at least: free_fleet's and the original benchmark's 2 Hz."""
PLACE, STATE, COUNT = hole(3, "<f4"), hole(1, "<u4"), hole(1, "<u8")
"""Positions of x, y, yaw; of the mode; and of the number of the message."""
RMF_MODE: dict[int, int] = {Mode.WAITING: WAITING, Mode.ABORTED: ADAPTER_ERROR}
"""All other modes are MOVING."""


def fleet_states(context: RunContext, release: Release) -> TopicSource:
    """States of all robots, by estimates. RMF has 32-bit floats. Paths are left out: `/robot_0/plan` has them."""
    topic = Topic("/fleet_states", "rmf_fleet_msgs/FleetState", types=rmf_types(release))
    last_move = np.array([route.last_move for route in context.routes])
    modes = np.array([RMF_MODE.get(mode, MOVING) for mode in range(max(Mode) + 1)])
    throttle, said = Throttle(INTERVAL), 0

    def rows(block: Chunk) -> Rows | None:
        nonlocal said
        if not all(name in block for name in ("estimate", "level", "mode", "reached")):
            return None
        shown = throttle.due(block["time"])
        numbers = np.arange(said, said + len(shown))
        said += len(shown)
        mode = np.where(block["reached"][shown] >= last_move, IDLE, modes[block["mode"][shown]])
        return block["time"][shown], {
            "place": block["estimate"][shown],
            "mode": mode[..., None],
            "seq": numbers[:, None],
            "level": block["level"][shown],
        }

    def template(levels: tuple[int, ...]) -> Template:
        types, fleet = topic.types, context.fleet
        states = []
        for index, (robot, name, level) in enumerate(zip(fleet.robots, fleet.names, levels, strict=True)):
            place = rmf_message(
                types,
                "Location",
                t=time(STAMP),
                x=PLACE[0],
                y=PLACE[1],
                yaw=PLACE[2],
                obey_approach_speed_limit=False,
                approach_speed_limit=0.0,
                level_name=context.world.levels[level].name,
                index=0,
            )
            mode = rmf_message(types, "RobotMode", mode=STATE[0], mode_request_id=0, performing_action="")
            states.append(
                rmf_message(
                    types,
                    "RobotState",
                    name=name,
                    model=robot.name,
                    task_id=str(context.assigned[index]) if context.assigned else "",
                    seq=COUNT[0],
                    mode=mode,
                    battery_percent=100.0,
                    location=place,
                    path=[],
                )
            )
        value = rmf_message(types, "FleetState", name=FLEET, robots=states)
        return Template(topic.type, value, {"place": PLACE, "mode": STATE, "seq": COUNT}, types)

    return TopicSource(topic, Varying("level", template), rows)
