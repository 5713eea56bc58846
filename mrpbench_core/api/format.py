"""Contract of the kind *format* (provisional): what other programs write and read, such as the bags of ROS 2.

A format is a `WritableFormat`, a `ReadableFormat`, or both.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

import attrs
from numpy.typing import NDArray

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Float, array
from mrpbench_core.model.runs.recording import Chunk
from mrpbench_core.model.runs.run import RunContext

SOURCES = ("ground_truth", "tf", "amcl_pose", "odometry", "fleet_states")
"""Sources of poses, the best first."""


@attrs.frozen(kw_only=True)
class Track:
    """The poses of one robot from the best source in the recording; at least one row."""

    robot: str
    """The robot's name in the recording."""
    source: str
    """One of `SOURCES`."""
    topic: str
    placed: bool = True
    """True if poses are in the frame `map`; otherwise they are in a frame of the robot with an unknown origin."""
    time: Float = array("f8")
    """f8[k] seconds since the recording's first pose, strictly increasing."""
    pose: Float = array("f8", 3)
    """f8[k,3]: x, y (metres; finite), yaw (radians; NaN = unknown)."""
    height: Float = array("f8")
    """f8[k] metres, NaN = unknown."""
    levels: tuple[str, ...] = ()
    """Names of levels, one per row, if the source gives them."""


@attrs.frozen(kw_only=True)
class Signal:
    """Measurements or commands of one robot; at least one row."""

    robot: str
    channel: str
    """`odometry`, `command` or `scan_ranges`: rows are those of the channel of that name."""
    topic: str
    time: Float = array("f8")
    """f8[k] seconds since the recording's first pose."""
    rows: NDArray[Any] = attrs.field()
    """f8[k,c]; f4 for scans."""


@attrs.frozen(kw_only=True)
class Observed:
    """The content of a recording."""

    tracks: tuple[Track, ...]
    """In the natural order of the robots' names (`robot_2` before `robot_10`)."""
    estimates: tuple[Track, ...] = ()
    """Poses estimated by the localization, of robots with such a source."""
    signals: tuple[Signal, ...] = ()
    context: RunContext | None = None
    """Context of the run, if mrpbench made the recording."""
    channels: Mapping[str, NDArray[Any]] = attrs.field(factory=dict)
    """Channels of `model.runs.recording` that the recording contains unchanged, with the times of `tracks`."""
    complete: bool = True
    """False where the end of the recording is missing or damaged."""
    notes: tuple[str, ...] = ()
    """Data that could not be used, and what was used instead; one sentence each."""


class FormatWriter(ABC):
    """Writes one run."""

    @abstractmethod
    def write(self, chunk: Chunk) -> None:
        """Append the samples since the last chunk."""

    @abstractmethod
    def close(self) -> None:
        """Finish the file; until then it has a temporary name or is readable at any time."""

    def abandon(self) -> None:  # noqa: B027 - optional: there may be nothing to remove
        """Remove the unfinished file, because the run failed."""


class Format(Component):
    """A format of recordings, of another program."""

    group: ClassVar[str] = "mrpbench.formats"
    old_groups: ClassVar[tuple[str, ...]] = ("mrpbench.exporters", "mrpbench.importers")
    """Groups of earlier releases, whose components are read until the next one."""


class WritableFormat(Format):
    """Writes runs, during the run or from a stored recording."""

    old_groups: ClassVar[tuple[str, ...]] = ("mrpbench.exporters",)
    lacking: ClassVar[str] = "cannot be written, only read"
    """The fault of other formats, where this one is asked for."""

    @abstractmethod
    def open(self, context: RunContext, destination: Path) -> FormatWriter:
        """Begin to write to `destination`, a path without suffix in an existing folder; replace an existing file."""


class ReadableFormat(Format):
    """Reads recordings of real fleets and of other simulators."""

    old_groups: ClassVar[tuple[str, ...]] = ("mrpbench.importers",)
    lacking: ClassVar[str] = "cannot be read, only written"

    @abstractmethod
    def read(self, path: Path, robots: tuple[str, ...] = ()) -> Observed:
        """Read the robots that match these names or shell patterns from the recording at `path`; () = all robots.

        Raises:
            InputError: the recording cannot be read, or contains no pose of a robot; names what it contains.
        """
