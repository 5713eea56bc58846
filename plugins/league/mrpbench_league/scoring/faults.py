"""Broken rules: as many as are worth reading, and how many there are."""

from typing import NamedTuple

import attrs

KEPT = 1000


class Fault(NamedTuple):
    """A rule that is broken."""

    time: int
    """End of the step or tick; -1 = no time."""
    text: str

    def __str__(self) -> str:
        return self.text if self.time < 0 else f"time {self.time}: {self.text}"


@attrs.define
class Faults:
    """A list that keeps the first `KEPT`."""

    kept: list[Fault] = attrs.field(factory=list)
    count: int = 0

    def add(self, time: int, text: str) -> None:
        """Count a fault, and keep it if there is room."""
        self.count += 1
        if len(self.kept) < KEPT:
            self.kept.append(Fault(time, text))
