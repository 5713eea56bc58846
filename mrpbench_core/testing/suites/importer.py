"""Checks that every importer must pass."""

from pathlib import Path
from tempfile import TemporaryDirectory

from mrpbench_core.api.importer import Importer
from mrpbench_core.files.errors import InputError
from mrpbench_core.testing.faults import Fault, require
from mrpbench_core.testing.suites.component import ComponentConformance


class ImporterConformance(ComponentConformance):
    """Checks of importers: `class TestMine(ImporterConformance)`."""

    def make(self) -> Importer:
        """Return the importer to check."""
        raise NotImplementedError("define make(self) and return the importer to check")

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


def refuses(importer: Importer, path: Path) -> None:
    """Require one clear line about a path that holds no recording."""
    try:
        importer.read(path)
    except InputError as error:
        require("\n" not in str(error), f"its message has several lines, not one: {error}")
    except Exception as error:
        raise Fault(f"{path.name}: raises {type(error).__name__}, not InputError: {error}") from error
    else:
        raise Fault(f"{path.name}: reads a file that holds no recording")
