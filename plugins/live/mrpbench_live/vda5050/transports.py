"""Transports as messages: what the host of a fleet control tells it, which VDA 5050 leaves open."""

import json
from collections.abc import Sequence
from typing import Any

from mrpbench_live.fleet.transports import Transport
from mrpbench_live.vda5050.messages import timestamp

TRANSPORTS = "mrpbench/transports"
"""The topic."""


def transport_message(transport: Transport, maps: Sequence[str]) -> dict[str, Any]:
    """Return a transport: errands in order, each with places of which any will do, and the seconds to rest there."""
    task = transport.task
    places = [
        {"x": x, "y": y, "mapId": maps[level]}
        for (x, y, _), level in zip(task.goals.tolist(), task.levels, strict=True)
    ]
    errands = zip(task.by_errand(places), task.service.tolist(), strict=True)
    return {
        "transportId": transport.id,
        "timestamp": timestamp(),
        "errands": [{"places": list(some), "service": seconds} for some, seconds in errands],
    }


def read_errands(
    payload: bytes, level_of: dict[str, int]
) -> tuple[str, list[tuple[list[tuple[float, float, int]], float]]]:
    """Return the id of a transport, and of each errand its places (x, y, level) and the seconds of rest.

    Raises:
        ValueError, KeyError, TypeError: it is none.
    """
    message = json.loads(payload)
    errands = [
        ([(float(it["x"]), float(it["y"]), level_of[it["mapId"]]) for it in some["places"]], float(some["service"]))
        for some in message["errands"]
    ]
    if not errands or not all(places for places, _ in errands):
        raise ValueError("a transport without errands, or an errand without places")
    return str(message["transportId"]), errands
