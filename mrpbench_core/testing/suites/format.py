"""Checks that every format must pass; those of a direction are skipped for formats of the other."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mrpbench_core.api.format import SOURCES, Format, ReadableFormat, WritableFormat
from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.faults import Fault, Skip, require
from mrpbench_core.testing.fixtures.finished_run import chunks, context
from mrpbench_core.testing.suites.component import ComponentConformance

NAME = "run"


class FormatConformance(ComponentConformance):
    """Checks of formats: `class TestMine(FormatConformance)`."""

    def make(self) -> Format:
        """Return the format to check."""
        raise NotImplementedError("define make(self) and return the format to check")

    def recording(self, folder: Path) -> Path:
        """Write a recording of at least two robots to a folder and return its path, for the checks that read one.

        It is one that the format writes; `mrpbench check` skips these checks for a format that is only read.
        """
        if not isinstance(self.make(), WritableFormat):
            raise Skip("define recording(self, folder): it writes a recording and returns its path")
        self.export(folder)
        return min(folder.iterdir())

    def writable(self) -> WritableFormat:
        """Return the format, or skip the check if it is only read."""
        made = self.make()
        if not isinstance(made, WritableFormat):
            raise Skip("it is only read")
        return made

    def readable(self) -> ReadableFormat:
        """Return the format, or skip the check if it is only written."""
        made = self.make()
        if not isinstance(made, ReadableFormat):
            raise Skip("it is only written")
        return made

    def test_is_written_or_read(self) -> None:
        made = isinstance(self.make(), WritableFormat | ReadableFormat)
        require(made, "is derived neither from WritableFormat nor from ReadableFormat")

    def test_writes_a_run(self) -> None:
        with folder() as here:
            self.export(here)
            require(written(here), f"wrote nothing called {NAME} or {NAME}.<suffix>: write to the given path")
            require(not leftovers(here), f"leaves other files behind: {', '.join(leftovers(here))}")

    def test_writes_a_run_in_one_piece_or_many(self) -> None:
        with folder() as whole, folder() as pieces:
            self.export(whole, 100.0)
            self.export(pieces, 0.35)
            one, many = written(whole), written(pieces)
            require(one.keys() == many.keys(), f"writes {sorted(one)} from one chunk and {sorted(many)} from many")

    def test_writes_a_run_in_which_nothing_happened(self) -> None:
        with folder() as here:
            self.writable().open(context(), here / NAME).close()
            require(written(here), "wrote nothing for a run without chunks: `close` must finish the export")

    def test_replaces_an_earlier_export(self) -> None:
        with folder() as here:
            self.export(here)
            before = written(here)
            self.export(here)
            after = written(here)
            require(after.keys() == before.keys(), f"after a second export there is {sorted(after)}")
            grown = [name for name, size in after.items() if size > 1.5 * before[name] + 64]
            require(not grown, f"a second export appends to the first: {', '.join(grown)}")
            require(not leftovers(here), f"leaves other files behind: {', '.join(leftovers(here))}")

    def test_leaves_nothing_of_a_run_that_failed(self) -> None:
        with folder() as here:
            writer = self.writable().open(context(), here / NAME)
            writer.write(chunks(100.0)[0])
            writer.abandon()
            left = sorted(path.name for path in here.iterdir())
            require(not left, f"`abandon` leaves files behind: {', '.join(left)}")

    def test_reads_a_recording(self) -> None:
        with folder() as here:
            observed = self.readable().read(self.recording(here))
        require(len(observed.tracks) > 1, f"found {len(observed.tracks)} robots: the checks need a recording of two")
        for track in observed.tracks:
            require(
                track.source in SOURCES, f"robot {track.robot} has the source {track.source!r}, not one of {SOURCES}"
            )
            require(
                track.pose.shape == (len(track.time), 3), f"robot {track.robot} has poses of shape {track.pose.shape}"
            )
            require(len(track.height) == len(track.time), f"robot {track.robot} has {len(track.height)} heights")
            require((np.diff(track.time) > 0).all(), f"the times of robot {track.robot} do not increase")
            require(np.isfinite(track.pose[:, :2]).all(), f"robot {track.robot} has a position that is not finite")
        first = min(float(track.time[0]) for track in observed.tracks)
        require(first == 0, f"the first pose is at {first:g} s: count times from the first pose of the recording")

    def test_reads_only_the_robots_that_are_asked_for(self) -> None:
        with folder() as here:
            path = self.recording(here)
            names = [track.robot for track in self.readable().read(path).tracks]
            first, last = names[0], names[-1]
            for asked, wanted in ((first, first), (f"{last[:-1]}[{last[-1]}]", last)):
                robots = [track.robot for track in self.readable().read(path, (asked,)).tracks]
                require(robots == [wanted], f"asked for {asked!r}, it reads {robots}")

    def test_says_that_it_does_not_find_a_robot(self) -> None:
        with folder() as here:
            refuses(self.readable(), self.recording(here), ("nobody",))

    def test_refuses_a_missing_file(self) -> None:
        with folder() as here:
            refuses(self.readable(), here / "nothing")

    def test_refuses_an_empty_folder(self) -> None:
        with folder() as here:
            refuses(self.readable(), here)

    def test_refuses_a_file_of_something_else(self) -> None:
        with folder() as here:
            for name in ("x", "x.mcap", "x.db3", "x.csv"):
                file = here / name
                file.write_bytes(b"no recording")
                refuses(self.readable(), file)

    def export(self, here: Path, seconds: float = 1.0) -> None:
        """Write the run in chunks of so many seconds."""
        writer = self.writable().open(context(), here / NAME)
        for chunk in chunks(seconds):
            writer.write(chunk)
        writer.close()


@contextmanager
def folder() -> Iterator[Path]:
    """An empty folder."""
    with TemporaryDirectory(prefix="mrpbench-check-") as name:
        yield Path(name)


def written(here: Path) -> dict[str, int]:
    """Sizes in bytes of the files of an export, by path."""
    files = [path for path in here.rglob("*") if path.is_file()]
    return {str(path.relative_to(here)): path.stat().st_size for path in files if belongs(path.relative_to(here))}


def leftovers(here: Path) -> list[str]:
    """Files in the folder that do not belong to the export."""
    return sorted(path.name for path in here.iterdir() if not belongs(path.relative_to(here)))


def belongs(path: Path) -> bool:
    """Tell whether a path is the destination, that with a suffix, or inside it."""
    return path.parts[0] == NAME or path.parts[0].startswith(f"{NAME}.")


def refuses(chosen: ReadableFormat, path: Path, robots: tuple[str, ...] = ()) -> None:
    """Require one clear line about a path that holds no recording, or none of these robots."""
    try:
        chosen.read(path, robots)
    except InputError as error:
        require("\n" not in str(error), f"its message has several lines, not one: {error}")
    except Exception as error:
        raise Fault(f"{path.name}: raises {type(error).__name__}, not InputError: {error}") from error
    else:
        raise Fault(f"{path.name}: reads what is not there")
