"""Draws a share of the runs by their ids and a key, so that neither publisher nor reader chooses them."""

import math
from collections.abc import Iterable
from hashlib import sha256


def drawn(run_ids: Iterable[str], share: float, key: str = "") -> list[str]:
    """Return the share of the ids, rounded up, whose SHA-256 with the key is the least."""
    ranked = sorted(run_ids, key=lambda run_id: sha256(f"{key}:{run_id}".encode()).digest())
    return ranked[: math.ceil(share * len(ranked) - 1e-9)]
