"""The format `rosbag2` and its options."""

from pathlib import Path

import attrs

from mrpbench_core.api.component import between, option
from mrpbench_core.api.format import Observed, ReadableFormat, WritableFormat
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.bag import Storage, Version
from mrpbench_exporters_rosbag2.bag_writer import BagWriter
from mrpbench_exporters_rosbag2.reading.bag_reader import BagReader
from mrpbench_exporters_rosbag2.rmf import Release
from mrpbench_exporters_rosbag2.topics import check_patterns, selected

LATEST_START = 2_140_000_000.0
"""seconds; ROS 2 counts them in 32 bits."""

READING = (
    *("ground_truth", "amcl_pose", "odometry", "command", "scan", "tf", "fleet_states", "fleet"),
    *("map_frame", "base_frames"),
)
"""Options that have no effect on what is written."""


@attrs.frozen(kw_only=True)
class Rosbag2(WritableFormat, ReadableFormat):
    """A rosbag2 (mcap or sqlite3). Runs are written with the topics and frames that RViz, Foxglove and Nav2 expect.
    Bags of any ROS 2 distribution are read, with the message definitions that they hold.

    The options from `ground_truth` on are for reading. In patterns, `{robot}` stands for a robot's name; where no topic
    fits, a lone robot is looked for in `/odom` and so on. Poses of topics are read from Odometry, PoseStamped and
    PoseWithCovarianceStamped, by the stamps of their headers; by the log time where a topic has none.
    """

    storage: Storage = option("mcap", help="`mcap` (compressed with zstd) or `sqlite3`")
    version: Version = option(9, help="of the bag's metadata: 9 for Jazzy and later, 8 for Humble and Iron")
    start_time: float = option(
        0.0,
        help="time of the bag's clock when the run begins",
        unit="s",
        validator=between(0, LATEST_START),
    )
    topics: tuple[str, ...] = option(
        ("*",), help="patterns of the topics to write, e.g. `/tf*` or `/robot_*/odom`", validator=check_patterns
    )
    rmf: Release = option(
        "humble",
        help="release of the messages of `/fleet_states`: `galactic` as the original benchmark ran, `humble` to Jazzy, "
        "or `rolling`",
    )
    map_resolution: float = option(
        0.05,
        help="of `/map`; a world that is a raster keeps its own",
        unit="m",
        former="map_cell_size",
        validator=attrs.validators.gt(0),
    )
    ground_truth: tuple[str, ...] = option(("/{robot}/ground_truth",), help="topics with true poses in `map`")
    amcl_pose: tuple[str, ...] = option(("/{robot}/amcl_pose",), help="topics with poses that localization estimates")
    odometry: tuple[str, ...] = option(("/{robot}/odom",), help="topics with odometry")
    command: tuple[str, ...] = option(("/{robot}/cmd_vel",), help="topics with commands, Twist or TwistStamped")
    scan: tuple[str, ...] = option(("/{robot}/scan",), help="topics with laser scans; empty = they are left out")
    tf: tuple[str, ...] = option(("/{robot}/tf",), help="topics with the transforms of one robot, in addition to `/tf`")
    fleet_states: tuple[str, ...] = option(("/fleet_states",), help="topics with rmf_fleet_msgs/FleetState")
    fleet: str = option("", help="name of the fleet whose states are read; empty = all fleets")
    map_frame: str = option("map", help="the frame in which the world is given")
    base_frames: tuple[str, ...] = option(
        ("{robot}/base_footprint", "{robot}/base_link"), help="frames of the robots' bases, the first that there is"
    )

    def idle_options(self) -> dict[str, str]:
        """Return the options of reading, and those of topics that are not written."""
        needs = {"rmf": "/fleet_states", "map_resolution": "/map"}
        return dict.fromkeys(READING, "it is for reading bags") | {
            name: f"`topics` leaves out {topic}" for name, topic in needs.items() if not selected(topic, self.topics)
        }

    def open(self, context: RunContext, destination: Path) -> BagWriter:
        """Begin the bag `destination`, a folder, with what is known before the run."""
        return BagWriter(self, context, destination)

    def read(self, path: Path, robots: tuple[str, ...] = ()) -> Observed:
        """Read the bag at `path`, a folder or a storage file."""
        return BagReader(self).read(path, robots)
