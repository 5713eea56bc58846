"""Checks versions and sources: those of the records against each other, and against the installed ones."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.plugins.local import LocalSource
from mrpbench_core.plugins.siblings import sibling_imports
from mrpbench_publish.bundles.checks.study import Asked
from mrpbench_publish.bundles.opened import Opened, Stored
from mrpbench_publish.bundles.verdict import Fault


def code_faults(bundle: Opened, asked: Asked, records: Sequence[Stored]) -> Iterator[Fault | str]:
    """Yield versions that differ within the bundle or from the installed ones, and sources with another hash."""
    now = asked.runs
    hashes: dict[str, str | None] = {}
    for stored in records:
        made = stored.provenance
        versions, components = made.get("versions"), made.get("components")
        if not isinstance(versions, dict) or not isinstance(components, list):
            yield stored.run_id, "does not say with which versions it was made"
            continue
        document = bundle.documents.by_name.get(stored.shard, {}).get("versions") or {}
        for name, version in versions.items():
            if document.get(name) != version:
                yield stored.run_id, f"says {name} {version}, its invocation {document.get(name)}"
        point = now.get(stored.run_id)
        if point is not None:
            yield from ((stored.run_id, fault) for fault in _differences(made, point.code))
        for entry in components:
            name = entry.get("file") if isinstance(entry, dict) else None
            if isinstance(name, str) and name.endswith(".py") and "sha256" in entry:
                if name not in hashes:
                    hashes[name] = _source_hash(bundle, name)
                if hashes[name] != entry["sha256"]:
                    yield stored.run_id, f"was made with another source of {name} than the one in the bundle"


def _differences(made: dict[str, Any], here: dict[str, Any]) -> Iterator[str]:
    other = set()
    for name in dict.fromkeys([*made["versions"], *here["versions"]]):
        claimed, installed = made["versions"].get(name), here["versions"].get(name)
        if claimed != installed:
            other.add(f"{name} {claimed}")
            yield f"was made with {name} {claimed}; {installed or 'none'} is installed here"
    known = {f"{entry['kind']} {entry['name']}": entry for entry in here["components"]}
    for entry in made["components"]:
        if not isinstance(entry, dict):
            yield "lists a component that is none"
            continue
        mine = known.pop(f"{entry.get('kind')} {entry.get('name')}", None)
        if mine != entry and f"{entry.get('distribution')} {entry.get('version')}" not in other:
            what = f"{entry.get('kind')} {entry.get('name')!r:.80}"
            yield f"was made with another {what}: {_origin(entry)}, here {_origin(mine)}"
    for entry in known.values():
        yield f"does not list the {entry['kind']} {entry['name']!r:.80}, which it needs"


def _origin(entry: dict[str, Any] | None) -> str:
    if entry is None:
        return "none"
    if "distribution" in entry:
        return f"{entry['distribution']} {entry.get('version')}"
    return f"SHA-256 {str(entry.get('sha256'))[:12]}"


def _source_hash(bundle: Opened, name: str) -> str | None:
    """Hash of a local plugin with the modules that it imports, none of which is executed."""
    file = Path(bundle.folder, name)
    if bundle.leaves_inputs(name) or not file.is_file():
        return None
    try:
        text = read_text(file)
        return LocalSource(file, text, sibling_imports(file, text, {})).sha256
    except InputError:
        return None
