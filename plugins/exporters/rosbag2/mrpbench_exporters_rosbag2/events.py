"""The messages with events and contacts, as diagnostics."""

import math
from collections.abc import Iterator

import numpy as np

from mrpbench_core.model.runs.recording import Chunk
from mrpbench_exporters_rosbag2.messages import Topic, header, message, nanoseconds, serialize

EVENTS = Topic("/events", "diagnostic_msgs/DiagnosticArray")
CONTACTS = Topic("/contacts", "diagnostic_msgs/DiagnosticArray")
WARNING = 1
"""Level of every status: a warning, since an event does not stop a run."""


def events(block: Chunk, names: tuple[str, ...], start: int) -> Iterator[tuple[int, bytes]]:
    """One message per event: which robot, what kind, and the detail."""
    if "event_time" in block:
        stamps = (nanoseconds(block["event_time"]) + start).tolist()
        rows = (block[name].tolist() for name in ("event_kind", "event_robot", "event_detail"))
        for stamp, kind, robot, detail in zip(stamps, *rows, strict=True):
            yield stamp, _diagnostic(stamp, _name(robot, names, "fleet"), kind, {"detail": detail})


def contacts(block: Chunk, names: tuple[str, ...], start: int) -> Iterator[tuple[int, bytes]]:
    """One message per pair in contact and control period."""
    if "contact_time" in block:
        stamps = (nanoseconds(block["contact_time"]) + start).tolist()
        forces = block.get("contact_force", np.full(len(stamps), np.nan)).tolist()
        for stamp, (robot, other), force in zip(stamps, block["contact"].tolist(), forces, strict=True):
            values = {"other": _name(other, names, "wall")} | ({} if math.isnan(force) else {"force": repr(force)})
            yield stamp, _diagnostic(stamp, names[robot], "contact", values)


def _name(robot: int, names: tuple[str, ...], otherwise: str) -> str:
    return names[robot] if robot >= 0 else otherwise


def _diagnostic(stamp: int, name: str, kind: str, values: dict[str, str]) -> bytes:
    status = message(
        "diagnostic_msgs/DiagnosticStatus",
        level=WARNING,
        name=name,
        message=kind,
        hardware_id=name,
        values=[message("diagnostic_msgs/KeyValue", key=key, value=value) for key, value in values.items()],
    )
    return serialize(EVENTS.type, message(EVENTS.type, header=header(stamp, ""), status=[status]))
