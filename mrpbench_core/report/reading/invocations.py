"""What the invocations in results folders say: with what, where and how their runs were made."""

from collections.abc import Iterable
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import load
from mrpbench_core.store.results import Results


def read_invocations(folders: Iterable[Results]) -> list[dict[str, Any]]:
    """Facts of each invocation, oldest first; one that cannot be read, as in a half-copied folder, says nothing."""
    found = []
    for results in folders:
        for file in sorted((results.folder.path / "invocations").glob("*.yaml")):
            try:
                data = load(file).data
            except InputError:
                continue
            if isinstance(data, dict):
                found.append(data)
    return found


def made_with(invocations: Iterable[dict[str, Any]]) -> dict[str, tuple[str, ...]]:
    """Every version of each distribution, and every processor, that took part."""
    parts: dict[str, dict[str, None]] = {}
    for entry in invocations:
        facts = dict(entry.get("versions") or {})
        facts["processor"] = (entry.get("machine") or {}).get("processor")
        for name, value in facts.items():
            if value is not None:
                parts.setdefault(name, {})[str(value)] = None
    return {name: tuple(values) for name, values in parts.items()}
