"""Reads the invocations in results folders: versions, machines and configurations of their runs.

The documents may come from others: parts of another type than `mrpbench run` writes are left out.
"""

from collections.abc import Iterable
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import load
from mrpbench_core.store.results import Results

_TYPES = {"machine": dict, "versions": dict, "columns": dict, "overrides": list}


def read_invocations(folders: Iterable[Results]) -> list[dict[str, Any]]:
    """Return the documents of all invocations, oldest first; skip unreadable ones, as in a half-copied folder."""
    found = []
    for results in folders:
        for file in sorted((results.folder.path / "invocations").glob("*.yaml")):
            try:
                data = load(file).data if file.is_file() else None
            except InputError:
                continue
            if isinstance(data, dict):
                found.append({key: value for key, value in data.items() if isinstance(value, _TYPES.get(key, object))})
    return found


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
