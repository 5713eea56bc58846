"""Checks the records against the runs that the studies describe."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import attrs

from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.plugins.local import is_local
from mrpbench_publish.bundles.expected import Expected, Invocation, expect
from mrpbench_publish.bundles.opened import Opened, Stored
from mrpbench_publish.bundles.verdict import Fault


@attrs.frozen(kw_only=True)
class Asked:
    """What the invocations of a bundle were asked to do."""

    by_name: Mapping[str, Expected]
    """The runs of each invocation, as far as its configuration can be read here."""
    faults: tuple[str, ...]
    """Why configurations cannot be read."""

    @property
    def runs(self) -> dict[str, StudyRun]:
        """All runs, by id."""
        return {point.run_id: point for expected in self.by_name.values() for point in expected.study.runs}

    def run(self, stored: Stored) -> StudyRun | None:
        """The run of a record, as its own invocation describes it."""
        expected = self.by_name.get(stored.shard)
        points = () if expected is None else expected.study.runs
        return next((point for point in points if point.run_id == stored.run_id), None)


def read_studies(bundle: Opened, slots: str, *, trusted: bool) -> Asked:
    """Read the configurations of all invocations, each different one once."""
    known: dict[str, Expected | str] = {}
    by_name: dict[str, Expected] = {}
    for name, invocation in bundle.documents.invocations(bundle.results, bundle.names).items():
        key = repr(invocation)
        if key not in known:
            known[key] = _read(bundle, invocation, slots, trusted)
        expected = known[key]
        if isinstance(expected, Expected):
            by_name[name] = expected
    return Asked(by_name=by_name, faults=tuple(dict.fromkeys(it for it in known.values() if isinstance(it, str))))


def study_faults(bundle: Opened, asked: Asked, records: Sequence[Stored]) -> Iterator[Fault | str]:
    """Yield missing and further records, and those whose configuration is not the one of their invocation.

    The id of a run is computed from the study, so that a record with the right configuration has the right id.
    """
    yield from asked.faults
    wanted, recorded = asked.runs, {stored.run_id for stored in records}
    yield from ((run_id, "is a run of the study without a record") for run_id in wanted if run_id not in recorded)
    points = {
        name: {point.run_id: point.canonical for point in expected.study.runs}
        for name, expected in asked.by_name.items()
    }
    for stored in records:
        if stored.shard not in points or uses_local_code(stored.record["config"]):
            continue
        canonical = points[stored.shard].get(stored.run_id)
        if canonical is None:
            yield stored.run_id, "is not a run of the study of its invocation: its id does not follow from it"
        elif canonical != stored.record["config"]:
            changed = sorted(key for key in canonical if canonical[key] != stored.record["config"].get(key))
            yield stored.run_id, f"has another configuration than its id says: {', '.join(changed) or 'further keys'}"
    errors = [str(error) for expected in asked.by_name.values() for error in expected.study.errors]
    if recorded - wanted.keys():
        yield from dict.fromkeys(error for error in errors if _NOT_EXECUTED not in error)
    for name, expected in asked.by_name.items():
        if dict(bundle.documents.by_name[name]["columns"]) != expected.study.columns:
            yield name, "declares other columns, units or directions than its metrics do"


def uses_local_code(config: Any) -> bool:
    """Tell whether a canonical configuration names a local plugin, which is code of its author."""
    if isinstance(config, Mapping):
        plugin = config.get("plugin")
        return (isinstance(plugin, str) and is_local(plugin)) or any(map(uses_local_code, config.values()))
    return isinstance(config, list | tuple) and any(map(uses_local_code, config))


def outside_faults(bundle: Opened, asked: Asked) -> Iterator[str]:
    """Yield files of the studies that are not in the bundle."""
    for name in dict.fromkeys(name for expected in asked.by_name.values() for name in expected.files):
        if bundle.leaves_inputs(name):
            yield f"the configuration names {name!r:.80}, which is not in the bundle"


_NOT_EXECUTED = "is not executed here"


def _read(bundle: Opened, invocation: Invocation, slots: str, trusted: bool) -> Expected | str:
    try:
        return expect(slots, invocation, bundle.folder, trusted=trusted)
    except InputErrors as several:
        texts = _first([str(error) for error in several.errors if trusted or _NOT_EXECUTED not in str(error)])
        return f"the study cannot be read here: {texts}" if texts else _LOCAL_ONLY
    except InputError as error:
        return f"the study cannot be read here: {error}"


_LOCAL_ONLY = "every run of the study needs local plugins, which are not executed (--trust-sources executes them)"


def _first(texts: Iterable[str]) -> str:
    distinct = list(dict.fromkeys(texts))
    return "; ".join(distinct[:3]) + ("; …" if len(distinct) > 3 else "")
