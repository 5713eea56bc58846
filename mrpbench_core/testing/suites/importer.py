"""Checks that every importer must pass."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mrpbench_core.api.importer import SOURCES, Importer
from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.suites.component import ComponentConformance


class ImporterConformance(ComponentConformance):
    """Checks of importers: `class TestMine(ImporterConformance)`."""

    def make(self) -> Importer:
        """Return the importer to check."""
        raise NotImplementedError("define make(self) and return the importer to check")

    def recording(self, folder: Path) -> Path:  # noqa: ARG002 - for those that override it
        """Write a recording of at least two robots to a folder and return its path, for the checks that read one.

        `mrpbench check` knows no recording and skips them.
        """
        raise Skip("define recording(self, folder): it writes a recording and returns its path")

    def test_reads_a_recording(self) -> None:
        with TemporaryDirectory() as folder:
            found = self.make().read(self.recording(Path(folder)))
        require(len(found.tracks) > 1, f"found {len(found.tracks)} robots: the checks need a recording of two")
        for track in found.tracks:
            require(
                track.source in SOURCES, f"robot {track.robot} has the source {track.source!r}, not one of {SOURCES}"
            )
            require(
                track.pose.shape == (len(track.time), 3), f"robot {track.robot} has poses of shape {track.pose.shape}"
            )
            require(len(track.height) == len(track.time), f"robot {track.robot} has {len(track.height)} heights")
            require((np.diff(track.time) > 0).all(), f"the times of robot {track.robot} do not increase")
            require(np.isfinite(track.pose[:, :2]).all(), f"robot {track.robot} has a position that is not finite")
        first = min(float(track.time[0]) for track in found.tracks)
        require(first == 0, f"the first pose is at {first:g} s: count times from the first pose of the recording")

    def test_reads_only_the_robots_that_are_asked_for(self) -> None:
        with TemporaryDirectory() as folder:
            path = self.recording(Path(folder))
            names = [track.robot for track in self.make().read(path).tracks]
            first, last = names[0], names[-1]
            for asked, wanted in ((first, first), (f"{last[:-1]}[{last[-1]}]", last)):
                found = [track.robot for track in self.make().read(path, (asked,)).tracks]
                require(found == [wanted], f"asked for {asked!r}, it reads {found}")

    def test_says_that_it_does_not_find_a_robot(self) -> None:
        with TemporaryDirectory() as folder:
            refuses(self.make(), self.recording(Path(folder)), ("nobody",))

    def test_refuses_a_missing_file(self) -> None:
        with TemporaryDirectory() as folder:
            refuses(self.make(), Path(folder) / "nothing")

    def test_refuses_an_empty_folder(self) -> None:
        with TemporaryDirectory() as folder:
            refuses(self.make(), Path(folder))

    def test_refuses_a_file_of_something_else(self) -> None:
        with TemporaryDirectory() as folder:
            for name in ("x", "x.mcap", "x.db3", "x.csv"):
                file = Path(folder) / name
                file.write_bytes(b"no recording")
                refuses(self.make(), file)


def refuses(importer: Importer, path: Path, robots: tuple[str, ...] = ()) -> None:
    """Require one clear line about a path that holds no recording, or none of these robots."""
    try:
        importer.read(path, robots)
    except InputError as error:
        require("\n" not in str(error), f"its message has several lines, not one: {error}")
    except Exception as error:
        raise Fault(f"{path.name}: raises {type(error).__name__}, not InputError: {error}") from error
    else:
        raise Fault(f"{path.name}: reads what is not there")
