"""Packs the motion of people and other movers for the page."""

from typing import Any

import numpy as np

from mrpbench_core.store.recording import Recording
from mrpbench_replay.motion import ANGLE
from mrpbench_replay.packing import Packing


def pack_movers(recording: Recording, packing: Packing) -> list[dict[str, Any]]:
    """Return names and radii by index, and pack a row per mover with a column per sample; [] without movers."""
    members = recording.context().movers
    if not members or "mover" not in recording.channels:
        return []
    mover, level = recording.channel("mover"), recording.channel("mover_level")
    for index, axis in enumerate("xy"):
        packing.add_metres(f"mover_{axis}", mover[..., index].T)
    packing.add_metres("mover_yaw", np.unwrap(mover[..., 2], axis=0).T, ANGLE)
    packing.add("mover_level", level.T)
    names = recording.context().mover_names
    return [
        {"name": name, "kind": member.kind, "radius": round(member.radius, 3)}
        for name, member in zip(names, members, strict=True)
    ]
