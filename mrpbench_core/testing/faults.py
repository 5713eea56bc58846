"""Exceptions of checks: a fault, or that the check does not apply."""

from unittest import SkipTest

Skip = SkipTest
"""Raised where a check does not apply; pytest reports it as skipped."""


class Fault(AssertionError):  # noqa: N818 - the fault is the component's
    """The fault of a component, in one sentence."""


def require(holds: object, otherwise: str) -> None:
    """Raise `Fault` with the sentence `otherwise` unless `holds`."""
    if not holds:
        raise Fault(otherwise)
