"""The suites catch faults of metrics and formats: each plugin here has one and fails its check."""

import attrs
import numpy as np
import pytest
from mrpbench_tests.variant import variant

from mrpbench_core.api import (
    Column,
    FormatWriter,
    Metric,
    WritableFormat,
    option,
)
from mrpbench_core.testing import failed_checks, suite_for


@attrs.frozen(kw_only=True)
class First(Metric):
    """The place where the first robot ended."""

    columns = (Column("x", "m", "neither", "of the first robot"),)
    requires = frozenset({"truth"})

    def measure(self, run):
        return {"x": float(run.channel("truth")[-1, 0, 1])}


def one(value, *names):
    return lambda self, run: dict.fromkeys(names or ("x",), value)


@pytest.mark.parametrize(
    ("changes", "check"),
    [
        ({}, "does not depend on the order of robots"),
        ({"measure": one(float("nan"))}, "gives exactly its columns"),
        ({"measure": one("far")}, "gives exactly its columns"),
        ({"measure": one(1.0, "x", "y")}, "gives exactly its columns"),
        ({"measure": one(1.0, "y")}, "gives exactly its columns"),
        ({"requires": frozenset({"truths"})}, "requires channels that exist"),
        ({"requires": frozenset()}, "needs no channel that it does not require"),
        ({"columns": ()}, "describes its columns"),
        ({"columns": First.columns * 2}, "describes its columns"),
        ({"columns": (Column("x", "m", "higher", "far", drawn="profile"),)}, "describes its columns"),
        ({"measure": lambda self, run: {"x": np.random.default_rng().random()}}, "measures the same again"),
        ({"measure": lambda self, run: {"x": run.channel("truth").sort() or 1.0}}, "gives exactly its columns"),
    ],
)
def test_a_metric(changes, check):
    assert check in failed_checks(suite_for(variant(First, **changes)()))


@attrs.frozen(kw_only=True)
class Text(WritableFormat):
    """Counts samples in a text file."""

    mode: str = option("w", help="how to open the file")
    scratch: bool = option(False, help="leave a scratch file behind")
    careless: bool = option(False, help="forget to remove the file of a failed run")

    def open(self, context, destination):
        return TextSession(self, destination)


class TextSession(FormatWriter):
    def __init__(self, options, destination):
        self.options, self.file = options, destination.with_suffix(".txt")
        self.stream = self.file.open(options.mode)

    def write(self, chunk):
        self.stream.write(f"{len(chunk.get('time', ()))} samples, written one after another\n")

    def close(self):
        self.stream.close()
        if self.options.scratch:
            self.file.with_name("scratch").write_text("forgotten")

    def abandon(self):
        self.stream.close()
        if not self.options.careless:
            self.file.unlink()


def test_a_format_that_is_written():
    assert not failed_checks(suite_for(Text()))
    assert set(failed_checks(suite_for(Text(mode="a")))) == {"replaces an earlier export"}
    assert set(failed_checks(suite_for(Text(scratch=True)))) == {"writes a run", "replaces an earlier export"}
    assert set(failed_checks(suite_for(Text(careless=True)))) == {"leaves nothing of a run that failed"}
