"""Contract of the kind *importer* (provisional): it reads recordings of real fleets and of other simulators."""

from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

import attrs
from numpy.typing import NDArray

from mrpbench_core.api.component import Component
from mrpbench_core.model.common.arrays import Float, array
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


class Importer(Component):
    """Reads recordings that another program or an exporter wrote."""

    group: ClassVar[str] = "mrpbench.importers"

    @abstractmethod
    def read(self, path: Path, robots: tuple[str, ...] = ()) -> Observed:
        """Read the robots that match these names or shell patterns from the recording at `path`; () = all robots.

        Raises:
            InputError: the recording cannot be read, or contains no pose of a robot; names what it contains.
        """
