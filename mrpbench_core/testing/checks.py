"""Runs a suite without pytest: one outcome for each check."""

import traceback
from collections.abc import Iterator
from typing import Literal

import attrs

from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.testing.faults import Fault, Skip


@attrs.frozen
class Check:
    """The outcome of one check."""

    name: str
    """The behaviour of the component that the check expects, in words."""
    outcome: Literal["ok", "failed", "skipped"]
    reason: str = ""


def run_checks(suite: object) -> Iterator[Check]:
    """Run every check of a suite in the order of the source, beginning with the checks of all kinds."""
    for method in methods(type(suite)):
        yield run_check(suite, method)


def run_check(suite: object, method: str) -> Check:
    """Run one check of a suite."""
    name = words(method)
    try:
        getattr(suite, method)()
    except Skip as skip:
        return Check(name, "skipped", str(skip))
    except (Fault, InputError) as fault:
        return Check(name, "failed", str(fault))
    except (Exception, SystemExit) as error:  # noqa: BLE001 - any exception of a plugin is a fault
        last = traceback.extract_tb(error.__traceback__)[-1]
        return Check(name, "failed", f"raises {one_line(error)} ({last.filename}:{last.lineno})")
    return Check(name, "ok")


def words(method: str) -> str:
    """What a check expects, from the name of its method."""
    return method.removeprefix("test_").replace("_", " ")


def failed_checks(suite: object) -> dict[str, str]:
    """The reason for each failed check, by name; empty if none failed."""
    return {check.name: check.reason for check in run_checks(suite) if check.outcome == "failed"}


def methods(suite: type[object]) -> list[str]:
    """The names of a suite's checks."""
    names = [name for owner in reversed(suite.__mro__) for name in vars(owner) if name.startswith("test_")]
    return [name for name in dict.fromkeys(names) if callable(getattr(suite, name))]
