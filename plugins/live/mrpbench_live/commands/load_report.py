"""What a load came to, from the recording of the vehicles alone."""

import json
from collections.abc import Sequence
from typing import Any, ClassVar

import attrs
import numpy as np

from mrpbench_core.store.recording import Recording
from mrpbench_live.commands.near_misses import near_misses

_CAUSES = (
    ("node_traversed", ""),
    ("order_accepted", "has an order and never left its first node: its base is no longer, or it is held"),
    ("refused", "refused every order: {}"),
    ("connection", "got no order"),
    ("", "was never connected"),
)
"""What a robot has come to, the furthest first, and what is said of one that came no further."""


@attrs.frozen(kw_only=True)
class LoadReport:
    """The steps of a load, and the robots that never drove."""

    COLUMNS: ClassVar[Sequence[str]] = (
        *("offered/h", "done/h", "open", "starved", "stuck", "contacts", "near"),
        *("order_p50_s", "order_p95_s", "order_p99_s", "done_p95_s", "cpu", "memory_MB", "kept_up"),
    )

    steps: list[dict[str, Any]]
    """As the events `load_step` have them, with the contacts and near misses of each."""
    silent: list[str]
    """One line for each robot that never passed a node."""

    @classmethod
    def of(cls, recording: Recording) -> "LoadReport":
        """Read a recording."""
        stamp, kind, robot, detail = (
            recording.channels[f"event_{name}"]().tolist() for name in ("time", "kind", "robot", "detail")
        )
        contacts = np.array([when for when, what in zip(stamp, kind, strict=True) if what == "contact"])
        moved, touched = ("time", "truth", "level"), ("contact_time", "contact")
        at, pose, level, *touches = (recording.channels[name]() for name in (*moved, *touched))
        near = near_misses(at, pose, level, recording.first_context().fleet.robots, *touches)
        steps = [json.loads(text) for what, text in zip(kind, detail, strict=True) if what == "load_step"]
        for step in steps:
            for name, times in (("contacts", contacts), ("near", near)):
                step[name] = int(((times >= step["begin"]) & (times < step["end"])).sum())
        robots = recording.channels["truth"]().shape[1]
        events = list(zip(kind, robot, detail, strict=True))
        lines = (_silence(number, [it for it in events if it[1] == number]) for number in range(robots))
        return cls(steps=steps, silent=[line for line in lines if line])

    def rows(self) -> list[list[Any]]:
        """Return a row for each step."""
        return [
            [
                *(step[key] for key in ("offered_per_hour", "done_per_hour", "open")),
                *(step[key] for key in ("starved", "stuck", "contacts", "near")),
                *(step["order_s"] or [None] * 3),
                (step["done_s"] or [None] * 3)[1],
                step["cpu"],
                None if step["memory"] is None else round(step["memory"] / 1e6),
                "yes" if step["kept_up"] else "no",
            ]
            for step in self.steps
        ]

    def answer(self) -> str:
        """Return the knee in one sentence."""
        kept = [step for step in self.steps if step["kept_up"]]
        lost = [step for step in self.steps if not step["kept_up"]]
        if not self.steps:
            return "no step is complete: raise limits.execution"
        if not kept:
            return f"it falls behind at {lost[0]['offered_per_hour']:g} transports per hour, the first rate"
        best = f"it keeps up with {kept[-1]['offered_per_hour']:g} transports per hour"
        if lost:
            return f"{best}, and falls behind at {lost[0]['offered_per_hour']:g}"
        return f"{best}, the last rate: raise limits.execution"


def _silence(number: int, events: Sequence[tuple[str, int, str]]) -> str | None:
    """Say why a robot never passed a node, or None if it did."""
    for kind, text in _CAUSES:
        details = [detail for what, _, detail in events if what == kind]
        if details or not kind:
            return f"robot_{number} {text.format(details[-1] if details else '')}" if text else None
    return None
