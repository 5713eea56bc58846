"""Writes one run as a bag: which topics, and in which order."""

from collections.abc import Iterator
from itertools import chain
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mrpbench_core.api.format import FormatWriter
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_exporters_rosbag2 import motion
from mrpbench_exporters_rosbag2.advance import advance
from mrpbench_exporters_rosbag2.bag import Bag
from mrpbench_exporters_rosbag2.blocks import AXES, Blocks
from mrpbench_exporters_rosbag2.covariances import Covariances
from mrpbench_exporters_rosbag2.doors_and_lifts import FacilityStates, facility_numbers
from mrpbench_exporters_rosbag2.events import CONTACTS, EVENTS, contacts, events
from mrpbench_exporters_rosbag2.fleet_states import fleet_states
from mrpbench_exporters_rosbag2.frames import frames
from mrpbench_exporters_rosbag2.local_plans import local_plan
from mrpbench_exporters_rosbag2.maps import RobotMap
from mrpbench_exporters_rosbag2.messages import Topic, message, nanoseconds, time
from mrpbench_exporters_rosbag2.people import mover_numbers, people, people_markers
from mrpbench_exporters_rosbag2.rmf import Release
from mrpbench_exporters_rosbag2.robots import robot_markers
from mrpbench_exporters_rosbag2.routes import routes
from mrpbench_exporters_rosbag2.scans import scan
from mrpbench_exporters_rosbag2.source import Rows, TopicSource
from mrpbench_exporters_rosbag2.start import opening
from mrpbench_exporters_rosbag2.template import STAMP, Template
from mrpbench_exporters_rosbag2.topics import selected

if TYPE_CHECKING:
    from mrpbench_exporters_rosbag2.rosbag2 import Rosbag2

POSES_PER_BLOCK = 16_384
"""Size of the blocks in memory, about 30 MB."""


class BagWriter(FormatWriter):
    """Writes one bag."""

    def __init__(self, recipe: "Rosbag2", context: RunContext, destination: Path) -> None:
        self.context = context
        self.names = context.fleet.names
        self.patterns = recipe.topics
        self.start = int(nanoseconds(recipe.start_time))
        self.sources = [source for source in sources(context, recipe.rmf) if self._wanted(source.topic)]
        self.facilities = FacilityStates(context.world)
        self.blocks = Blocks(max(1, POSES_PER_BLOCK // max(1, len(context.fleet))))
        latched = [said for said in opening(context, self.start, recipe.map_resolution) if self._wanted(said[0])]
        self.bag: Bag | None = Bag(destination, recipe.storage, recipe.version)
        self.bag.describe("mrpbench_run_id", context.run_id)
        for topic, data in latched:
            self.bag.write(topic, self.start, data)

    def write(self, chunk: Chunk) -> None:
        """Append the samples since the last chunk."""
        self._write(self.blocks.push(chunk))

    def close(self) -> None:
        """Write the last block and give the bag its name; do nothing after a failure or when called again."""
        if self.bag is not None:
            self._write(self.blocks.finish())
            self.bag.close()
            self.bag = None

    def abandon(self) -> None:
        """Remove the unfinished bag."""
        if self.bag is not None:
            self.bag.abandon()
            self.bag = None

    def _write(self, blocks: Iterator[Chunk]) -> None:
        assert self.bag is not None, "closed"
        try:
            for block in blocks:
                for stamp, topic, data in sorted(self._messages(block), key=itemgetter(0)):  # stable
                    self.bag.write(topic, stamp, data)
        except BaseException:
            self.abandon()
            raise

    def _messages(self, block: Chunk) -> Iterator[tuple[int, Topic, bytes]]:
        """The messages of a block, topic by topic."""
        said = [(source.topic, source.messages(block, self.start)) for source in self.sources]
        said.append((CONTACTS, contacts(block, (*self.names, *self.context.mover_names), self.start)))
        said.append((EVENTS, events(block, self.names, self.start)))
        yield from chain.from_iterable(
            ((stamp, topic, data) for stamp, data in messages) for topic, messages in said if self._wanted(topic)
        )
        yield from (new for new in self.facilities.messages(block, self.start) if self._wanted(new[1]))
        yield from (new for new in routes(block, self.context, self.start) if self._wanted(new[1]))

    def _wanted(self, topic: Topic) -> bool:
        return selected(topic.name, self.patterns)


def sources(context: RunContext, rmf: Release) -> Iterator[TopicSource | RobotMap]:
    """Every periodic topic, in the order of writing at one instant: the clock, frames before what stands in them."""
    robots = list(zip(context.fleet.names, context.fleet.robots, strict=True))
    covariances = Covariances()
    yield clock()
    yield frames(context.fleet.names, context.world)
    for index, (name, _) in enumerate(robots):
        yield motion.odometry(index, name, covariances)
        yield motion.amcl_pose(index, name, context.world, covariances)
        yield motion.ground_truth(index, name, context.world)
        yield motion.command(index, name)
    if robots:
        yield advance(len(robots))
        yield fleet_states(context, rmf)
    yield robot_markers(context)
    if context.movers:
        yield people(context)
        yield people_markers(context)
        yield mover_numbers(context)
    if Facilities(context.world).names:
        yield facility_numbers(context.world)
    for index, (name, robot) in enumerate(robots):
        if robot.lidar:
            yield scan(index, name, robot.lidar)
    for index, name in enumerate(context.fleet.names):
        yield local_plan(index, name, context.world)
        yield RobotMap(index, name, context.world)


def clock() -> TopicSource:
    """The simulated time of everything else."""

    def rows(block: Chunk) -> Rows:
        return np.unique(np.concatenate([block[axis] for axis in AXES if axis in block] or [np.empty(0)])), {}

    topic = Topic("/clock", "rosgraph_msgs/Clock")
    return TopicSource(topic, Template(topic.type, message(topic.type, clock=time(STAMP)), {}), rows)
