"""Checks that every exporter must pass."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from mrpbench_core.api.exporter import Exporter
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.fixtures.finished_run import chunks, context
from mrpbench_core.testing.suites.component import ComponentConformance

NAME = "run"


class ExporterConformance(ComponentConformance):
    """Checks of exporters: `class TestMine(ExporterConformance)`."""

    def make(self) -> Exporter:
        """Return the exporter to check."""
        raise NotImplementedError("define make(self) and return the exporter to check")

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
            self.make().open(context(), here / NAME).close()
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
            session = self.make().open(context(), here / NAME)
            session.write(chunks(100.0)[0])
            session.abandon()
            left = sorted(path.name for path in here.iterdir())
            require(not left, f"`abandon` leaves files behind: {', '.join(left)}")

    def export(self, here: Path, seconds: float = 1.0) -> None:
        """Write the run in chunks of so many seconds."""
        session = self.make().open(context(), here / NAME)
        for chunk in chunks(seconds):
            session.write(chunk)
        session.close()


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
