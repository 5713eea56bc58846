"""How a check says that something is wrong, or that it does not apply."""

from unittest import SkipTest

Skip = SkipTest
"""Raised where a check does not apply; pytest knows it too."""


class Fault(AssertionError):  # noqa: N818 - what is at fault is the component
    """What is wrong with a component, in one sentence."""


def require(holds: object, otherwise: str) -> None:
    """Raise `Fault` with the sentence `otherwise` unless `holds`."""
    if not holds:
        raise Fault(otherwise)
