"""Contract of the kind *importer* (provisional): recordings of real or otherwise simulated fleets."""

from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

import attrs
from numpy.typing import NDArray

from mrpbench_core.api.component import Component
from mrpbench_core.model.arrays import Float, array
from mrpbench_core.model.run import RunContext

SOURCES = ("ground_truth", "tf", "amcl_pose", "odometry", "fleet_states")
"""Where poses come from, the best first."""


@attrs.frozen(kw_only=True)
class Track:
    """Where one robot was, as the best of the sources that there are tells it. One row at least."""

    robot: str
    """The robot's name in the recording."""
    source: str
    """One of `SOURCES`."""
    topic: str
    placed: bool = True
    """Poses are in the frame `map`; else in a frame of the robot's own, which begins anywhere."""
    time: Float = array("f8")
    """f8[k] seconds since the recording's first pose, strictly increasing."""
    pose: Float = array("f8", 3)
    """f8[k,3]: x, y (metres), yaw (radians); finite."""
    height: Float = array("f8")
    """f8[k] metres, NaN = unknown."""
    levels: tuple[str, ...] = ()
    """Names of levels, one per row, where the source names them."""


@attrs.frozen(kw_only=True)
class Signal:
    """What one robot measured, or was told. One row at least."""

    robot: str
    channel: str
    """`odometry`, `command` or `scan_ranges`: rows are those of the channel of that name."""
    topic: str
    time: Float = array("f8")
    """f8[k] seconds, as of tracks."""
    rows: NDArray[Any] = attrs.field()
    """f8[k,c]; of scans f4."""


@attrs.frozen(kw_only=True)
class Observed:
    """What a recording holds."""

    tracks: tuple[Track, ...]
    """In the natural order of the robots' names (`robot_2` before `robot_10`)."""
    estimates: tuple[Track, ...] = ()
    """Where localization believed robots to be, of those that have such a source."""
    signals: tuple[Signal, ...] = ()
    context: RunContext | None = None
    """What was known before the run began, where mrpbench made the recording."""
    channels: Mapping[str, NDArray[Any]] = attrs.field(factory=dict)
    """Channels of `mrpbench_core.model.recording` that the recording holds as they are, with the times of `tracks`."""
    notes: tuple[str, ...] = ()
    """What could not be used, and what was used instead; one sentence each."""


class Importer(Component):
    """Reads recordings that another program, or an exporter, wrote."""

    group: ClassVar[str] = "mrpbench.importers"

    @abstractmethod
    def read(self, path: Path, robots: tuple[str, ...] = ()) -> Observed:
        """Return what the recording at `path` holds of the robots that these names or shell patterns name; () = all.

        Raises:
            InputError: it cannot be read at all, or holds no pose of any robot; says what there is.
        """
