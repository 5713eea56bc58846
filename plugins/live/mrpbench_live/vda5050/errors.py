"""The errors that a vehicle reports, and what ends each (6.6.5)."""

from collections.abc import Callable, Iterator, Mapping

import attrs

from mrpbench_live.vda5050.names import Names
from mrpbench_live.vda5050.orders import RefusedError

UNTIL_NEXT_ORDER, UNTIL_NEXT_INSTANT_ACTION, UNTIL_AVAILABLE = "order", "instantAction", "available"
UNTIL_NEXT_ZONE_SET, UNTIL_CORRECTED = "zoneSet", "corrected"
"""What ends an error."""
MOST = 16
"""Errors at a time."""


@attrs.frozen(kw_only=True)
class Error:
    """An error that a vehicle reports."""

    type: str
    level: str
    description: str
    references: Mapping[str, str]
    until: str
    """What ends it."""


class Errors:
    """The errors of one vehicle, one of each type.

    Args:
        names: of the version that it speaks.
        note: called with the kind of an event and one line about it.
        changed: called when there are others.
    """

    def __init__(self, names: Names, note: Callable[[str, str], None], changed: Callable[[], None]) -> None:
        self._names, self._note, self._changed = names, note, changed
        self._errors: list[Error] = []

    def __iter__(self) -> Iterator[Error]:
        return iter(self._errors)

    def refuse(self, refusal: RefusedError, until: str) -> None:
        """Report why something is refused."""
        until = UNTIL_AVAILABLE if refusal.kind == "MOBILE_ROBOT_NOT_AVAILABLE" else until
        name = self.report(refusal.kind, refusal.level, str(refusal), refusal.references, until)
        self._note("refused", f"{name}: {refusal}")

    def restrict(self, kind: str, description: str, references: Mapping[str, str]) -> None:
        """Report that the vehicle is, or was to go, where it may not be."""
        until = UNTIL_NEXT_ORDER if kind == "NODE_UNREACHABLE" else UNTIL_CORRECTED
        name = self.report(kind, "CRITICAL", description, references, until)
        self._note("out_of_bounds", f"{name}: {description}")

    def report(self, kind: str, level: str, description: str, references: Mapping[str, str], until: str) -> str:
        """Report an error by its type and level in 3.0; return its type in the version that the vehicle speaks."""
        name, level = self._names.error(kind, level)
        error = Error(type=name, level=level, description=description, references=references, until=until)
        self._errors = [*[other for other in self._errors if other.type != name][1 - MOST :], error]
        self._changed()
        return name

    def end(self, until: str) -> None:
        """Leave out the errors that something has ended."""
        self._keep([error for error in self._errors if error.until != until])

    def correct(self, kind: str) -> None:
        """Leave out an error by its type in 3.0."""
        name = self._names.error(kind, "CRITICAL")[0]
        self._keep([error for error in self._errors if error.type != name])

    def _keep(self, errors: list[Error]) -> None:
        if len(errors) < len(self._errors):
            self._changed()
        self._errors = errors
