"""Reads the invocations in results folders: versions, machines and configurations of their runs.

The documents may come from others: parts of another type than `mrpbench run` writes are left out.
"""

from collections.abc import Iterable
from typing import Any

from mrpbench_core.store.results import Results

_TYPES = {"machine": dict, "versions": dict, "columns": dict, "overrides": list}


def read_invocations(folders: Iterable[Results]) -> list[dict[str, Any]]:
    """Return the documents of all invocations, oldest first."""
    return [
        {key: value for key, value in data.items() if isinstance(value, _TYPES.get(key, object))}
        for results in folders
        for data in results.invocations
        if isinstance(data, dict)
    ]


def made_with(invocations: Iterable[dict[str, Any]]) -> dict[str, tuple[str, ...]]:
    """Return all versions of each distribution, and all processors, with which the runs were made."""
    parts: dict[str, dict[str, None]] = {}
    for entry in invocations:
        facts = dict(entry.get("versions") or {})
        facts["processor"] = (entry.get("machine") or {}).get("processor")
        for name, value in facts.items():
            if value is not None:
                parts.setdefault(name, {})[str(value)] = None
    return {name: tuple(values) for name, values in parts.items()}
