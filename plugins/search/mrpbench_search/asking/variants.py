"""Runs that differ from a run of a study by some options."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.config.canonical import canonical, sources
from mrpbench_core.config.identity import run_id
from mrpbench_core.config.shared import Shared
from mrpbench_core.config.study import RunPoint, Study
from mrpbench_core.config.unpacking import Unpacking
from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns, pack_study, unpack_study
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.plugins.provenance import components_in

Changes = Mapping[str, Any]
"""Plain values by dotted option, as `mrpbench_core.config.canonical` writes them."""


def read_variants(
    study: StudyRuns, point: StudyRun, changes: Sequence[Changes], labels: Sequence[Changes]
) -> StudyRuns:
    """Return a study with one run for each of some changes, in their order.

    Args:
        study: gives name, document and columns.
        point: the run that is changed.
        changes: what differs in each run.
        labels: what progress says of each run.

    Raises:
        InputErrors: an option does not exist, or a value is refused.
    """
    configs = [patched(point.canonical, each) for each in changes]
    parcel = {"folder": str(point.folder), "sources": point.sources}
    packed = in_worker("the runs of the search cannot be made", packed_runs, study.name, parcel, configs, list(labels))
    found = unpack_study(packed)
    return attrs.evolve(study, runs=found.runs, columns=found.columns, errors=(), notes=())


def patched(config: Mapping[str, Any], changes: Changes) -> dict[str, Any]:
    """Return a canonical configuration with other values of some options."""
    result = dict(config)
    for key, value in changes.items():
        result = _with(result, key.split("."), value)
    return result


def _with(item: Any, steps: Sequence[str], value: Any) -> Any:
    """Plain data with another value of the option to which some steps lead; a step into a list is an index."""
    if not steps:
        return value
    step, *rest = steps
    if isinstance(item, Mapping):
        return {**item, step: _with(item[step] if rest else None, rest, value)}
    place = int(step)
    return [*item[:place], _with(item[place], rest, value), *item[place + 1 :]]


def packed_runs(
    name: str, parcel: Mapping[str, Any], configs: Sequence[dict[str, Any]], labels: Sequence[dict[str, Any]]
) -> dict[str, Any]:
    """In a worker process: make runs of canonical configurations; see `mrpbench_core.engine.loading.runs`."""
    folder, shared = Path(parcel["folder"]), Shared()
    unpack = Unpacking()
    runs = []
    for plain, axes in zip(configs, labels, strict=True):
        config = unpack({**parcel, "config": plain})
        components = tuple(components_in(config))
        runs.append(
            RunPoint(
                run_id=run_id(config, folder, shared),
                config=config,
                components=components,
                canonical=canonical(config, folder, shared),
                axes=axes,
                folder=folder,
                sources=sources(components, folder),
            )
        )
    return pack_study(Study(name=name, file=None, folder=folder, runs=tuple(runs)))
