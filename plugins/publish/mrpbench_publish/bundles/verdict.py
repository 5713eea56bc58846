"""What the verification of a bundle found."""

from collections.abc import Iterable
from typing import Any, Literal

import attrs

Outcome = Literal["passed", "failed", "not checked"]
_NAMED = 3
"""Runs that a finding names."""
Fault = tuple[str, str]
"""A run, or another subject, and what is wrong with it."""


@attrs.frozen(kw_only=True)
class Check:
    """One check of a bundle."""

    name: str
    outcome: Outcome
    covered: str
    """What was checked, or why it was not."""
    findings: tuple[str, ...] = ()


@attrs.frozen(kw_only=True)
class Verdict:
    """All checks of a bundle."""

    bundle: str
    """Name of the file."""
    sha256: str
    version: str
    """Of mrpbench."""
    checks: tuple[Check, ...]
    seed: str | None = None
    """The seed by which runs were drawn and repeated; None = no run was repeated."""

    @property
    def passed(self) -> bool:
        """True if no check failed."""
        return all(check.outcome != "failed" for check in self.checks)

    def document(self) -> dict[str, Any]:
        """The verdict as plain data."""
        return {**attrs.asdict(self), "passed": self.passed}


def checked(name: str, faults: Iterable[Fault | str], covered: str, *, unchecked: str | None = None) -> Check:
    """Return a check with its faults.

    Args:
        name: of the check.
        faults: texts; those of several subjects are grouped by their text.
        covered: what was checked.
        unchecked: why nothing was; None = it was.
    """
    findings = grouped(faults)
    if findings:
        return Check(name=name, outcome="failed", covered=covered, findings=findings)
    if unchecked is not None:
        return Check(name=name, outcome="not checked", covered=unchecked)
    return Check(name=name, outcome="passed", covered=covered)


def grouped(faults: Iterable[Fault | str]) -> tuple[str, ...]:
    """Return one line for each different fault, with the first subjects that have it."""
    subjects: dict[str, list[str]] = {}
    for fault in faults:
        subject, text = ("", fault) if isinstance(fault, str) else fault
        subjects.setdefault(text, []).append(subject)
    return tuple(f"{_names(names)}{text}" for text, names in subjects.items())


def _names(subjects: list[str]) -> str:
    named = list(dict.fromkeys(filter(None, subjects)))
    if not named:
        return ""
    more = f" and {len(named) - _NAMED} more" if len(named) > _NAMED else ""
    return f"{', '.join(named[:_NAMED])}{more}: "
