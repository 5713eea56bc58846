"""The runs of a study as plain data, which cross from the worker that loads a configuration to the invoker."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.config.shared import Shared
from mrpbench_core.config.study import RunData, RunPoint, Study, load_study
from mrpbench_core.engine.asking import facts_of_run
from mrpbench_core.engine.loading.versions import code_of
from mrpbench_core.files.errors import InputError
from mrpbench_core.referee.measuring import describe


@attrs.frozen(kw_only=True)
class StudyRun(RunData):
    """One run of a study, as the invoker knows it."""

    code: dict[str, Any] = attrs.field(repr=False)
    """Its components and their versions; the same object for runs with the same ones."""
    facts: dict[str, Any] = attrs.field(repr=False)
    """See `mrpbench_core.engine.asking.facts_of_run`."""
    live: bool
    """Something outside of the process takes part."""
    wall_s: float
    memory_bytes: int


@attrs.frozen(kw_only=True)
class StudyRuns:
    """The runs that one configuration describes, each once; see `mrpbench_core.config.study.Study`."""

    name: str
    runs: tuple[StudyRun, ...]
    errors: tuple[InputError, ...] = ()
    document: Any = None
    notes: tuple[str, ...] = ()
    """What the configuration names without effect in any run, one line each."""
    columns: dict[str, Any] = attrs.field(factory=dict)
    """The declaration of each metric column; see `mrpbench_core.referee.measuring.describe`."""


def packed_study(source: str | Mapping[str, Any], overrides: Sequence[str]) -> dict[str, Any]:
    """Load a study; return it as plain data.

    Raises:
        InputErrors, InputError: see `mrpbench_core.config.study.load_study`.
    """
    return pack_study(load_study(source, overrides))


def pack_study(study: Study) -> dict[str, Any]:
    """A study as plain data; values that several runs share are given once."""
    values = _Values()
    metrics = {name: metric for point in study.runs for name, metric in point.config.metrics.items()}
    return {
        "name": study.name,
        "folder": str(study.folder),
        "errors_of_points": [pack_error(error) for error in study.errors],
        "document": study.document,
        "notes": study.notes,
        "columns": describe(metrics),
        "runs": [_packed(point, values) for point in study.runs],
        "values": values.texts,
    }


class _Values:
    """Plain values by number, each once."""

    def __init__(self) -> None:
        self.texts: list[str] = []
        self._numbers: dict[str, int] = {}
        self._shared = Shared()

    def __call__(self, value: Any) -> int:
        text = self._shared(json.dumps, value)
        if text not in self._numbers:
            self._numbers[text] = len(self.texts)
            self.texts.append(text)
        return self._numbers[text]


def _packed(point: RunPoint, values: _Values) -> list[Any]:
    limits = point.config.limits
    return [
        point.run_id,
        {key: values(value) for key, value in point.canonical.items()},
        point.axes,
        values(point.sources),
        values(code_of(point.components, point.folder)),
        values(facts_of_run(point.config)),
        any(component.live for component in point.components),
        limits.wall,
        limits.memory,
    ]


def unpack_study(study: dict[str, Any]) -> StudyRuns:
    """The study that `packed_study` returned."""
    values = [json.loads(text) for text in study["values"]]
    folder = Path(study["folder"])
    return StudyRuns(
        name=study["name"],
        errors=tuple(map(unpack_error, study["errors_of_points"])),
        document=study["document"],
        notes=tuple(study["notes"]),
        columns=study["columns"],
        runs=tuple(
            StudyRun(
                run_id=run_id,
                canonical={key: values[number] for key, number in canonical.items()},
                axes=axes,
                folder=folder,
                sources=values[sources],
                code=values[code],
                facts=values[facts],
                live=live,
                wall_s=wall_s,
                memory_bytes=memory_bytes,
            )
            for run_id, canonical, axes, sources, code, facts, live, wall_s, memory_bytes in study["runs"]
        ),
    )


def pack_error(error: InputError) -> dict[str, Any]:
    """An error as plain data."""
    return {
        "message": error.message,
        "file": None if error.file is None else str(error.file),
        "line": error.line,
        "column": error.column,
        "hint": error.hint,
    }


def unpack_error(fault: Mapping[str, Any]) -> InputError:
    """An error that `pack_error` returned."""
    return InputError(
        fault["message"], file=fault["file"], line=fault["line"], column=fault["column"], hint=fault["hint"]
    )
