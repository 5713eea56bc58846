"""Load a study: from a configuration file or dict to its runs."""

import os
from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.config.canonical import canonical, sources
from mrpbench_core.config.combinations import IdleOptions, refusals
from mrpbench_core.config.identity import run_id
from mrpbench_core.config.items import COMMAND_LINE, Item, Location, from_data, from_document
from mrpbench_core.config.matrix import Matrix, Point, parse_matrix
from mrpbench_core.config.overrides import parse_overrides
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.shared import Shared
from mrpbench_core.config.structure import Structure
from mrpbench_core.files.errors import InputError, InputErrors, in_reading_order, read_all
from mrpbench_core.files.yaml import load
from mrpbench_core.plugins.provenance import advice_of, components_in

NAMED_POINTS = 5
"""Points that an error names."""


@attrs.frozen(kw_only=True)
class RunData:
    """One run of a study as plain data."""

    run_id: str
    canonical: dict[str, Any] = attrs.field(repr=False)
    """The configuration, for records and workers; see `mrpbench_core.config.canonical`."""
    axes: dict[str, Any]
    """Plain values of the keys that vary in the study, by dotted key."""
    folder: Path
    sources: dict[str, str] = attrs.field(repr=False)
    """Texts of local plugins by file."""

    @property
    def parcel(self) -> dict[str, Any]:
        """Plain data from which another process makes the same configuration; see `mrpbench_core.config.unpacking`."""
        return {"config": self.canonical, "folder": str(self.folder), "sources": self.sources}


@attrs.frozen(kw_only=True)
class RunPoint(RunData):
    """One run of a study with its configuration."""

    config: RunConfig
    components: tuple[Component, ...] = attrs.field(repr=False)
    """All components of the configuration, outermost first."""


@attrs.frozen(kw_only=True)
class Study:
    """The runs that one configuration describes, each once."""

    name: str
    file: Path | None
    folder: Path
    """Folder of the configuration; its files are relative to it."""
    runs: tuple[RunPoint, ...]
    errors: tuple[InputError, ...] = ()
    """Errors of points that cannot be run, in reading order."""
    invalid: int = 0
    """Number of these points."""
    document: Any = None
    """The content of the file as plain data."""
    notes: tuple[str, ...] = ()
    """What the configuration names without effect in any run, one line each."""


def load_study(source: Path | str | Mapping[str, Any], overrides: Sequence[str] = ()) -> Study:
    """Read a configuration and return its study.

    Args:
        source: a file, or its content as a dict; files in a dict are relative to the working directory.
        overrides: `key=value`, as on the command line.

    Raises:
        InputError: the file cannot be read.
        InputErrors: all errors in reading order, if the file as a whole, an override or every point is wrong. If some
            points are right, `Study.errors` has the errors of the others.
    """
    if isinstance(source, Mapping):
        file, folder, root = None, Path.cwd(), from_data(source, Location())
    else:
        file = Path(source)
        folder = Path(os.path.abspath(file.parent))  # noqa: PTH100 - symbolic links are kept
        root = from_document(load(file))
    try:
        return _study(root, file, folder, overrides)
    except InputErrors as several:
        raise InputErrors(*in_reading_order(several.errors)) from None


def load_studies(files: Iterable[Path | str], overrides: Sequence[str] = ()) -> list[Study]:
    """Read several configurations; raise the errors of all of them together."""
    return read_all(lambda file: load_study(file, overrides), files)


def _study(root: Item, file: Path | None, folder: Path, overrides: Sequence[str]) -> Study:
    if not isinstance(root.value, dict):
        raise InputErrors(root.location.error("", "expected a block of settings such as `planner: cbs`"))
    settings = {key: inner for key, inner in root.value.items() if key != "matrix"}
    name = file.stem if file else "study"
    settings.setdefault("name", from_data(name, attrs.evolve(root.location, line=None, column=None)))
    matrix = parse_matrix(root.value["matrix"]) if "matrix" in root.value else Matrix()
    points = list(matrix.points(attrs.evolve(root, value=settings), parse_overrides(overrides, matrix)))
    if not points:
        raise InputErrors(root.value["matrix"].location.error("matrix", "excludes every point"))
    idle = IdleOptions()
    runs, faults = _structure(points, folder, idle)
    errors = _explain(faults, len(points))
    if not runs or any(error.file == COMMAND_LINE for error in errors):
        raise InputErrors(*errors)
    return Study(
        name=next(iter(runs.values())).config.name,
        file=file,
        folder=folder,
        runs=tuple(runs.values()),
        errors=tuple(errors),
        invalid=len({id(point) for _, broken in faults.values() for point in broken}),
        document=root.data,
        notes=(*idle.notes(), *_advice(runs.values())),
    )


def _advice(runs: Iterable[RunPoint]) -> list[str]:
    """Return a line for each component that is installed under a name of earlier releases."""
    classes = dict.fromkeys(type(component) for run in runs for component in run.components)
    return [advice for cls in classes if (advice := advice_of(cls))]


def _structure(
    points: Sequence[Point], folder: Path, idle: IdleOptions
) -> tuple[dict[str, RunPoint], dict[str, tuple[InputError, list[Point]]]]:
    """Return the runs by id, and each error with the points that it affects."""
    structurer, shared = Structure(folder), Shared()
    runs: dict[str, RunPoint] = {}
    faults: dict[str, tuple[InputError, list[Point]]] = {}
    for point in points:
        try:
            if point.fault:
                raise InputErrors(point.fault)
            config = structurer.run(point.root)
            if refused := refusals(config, point.root):
                raise InputErrors(*refused)
        except InputErrors as several:
            for error in several.errors:
                faults.setdefault(str(error), (error, []))[1].append(point)
            continue
        idle.add(config, point.root)
        identity = run_id(config, folder, shared)
        if identity not in runs:
            settings = (getattr(config, field.name) for field in attrs.fields(RunConfig))
            components = tuple(chain.from_iterable(shared(_components, setting) for setting in settings))
            runs[identity] = RunPoint(
                run_id=identity,
                config=config,
                components=components,
                canonical=canonical(config, folder, shared),
                axes=point.axes,
                folder=folder,
                sources=sources(components, folder),
            )
    return runs, faults


def _components(setting: Any) -> tuple[Component, ...]:
    return tuple(components_in(setting))


def _explain(faults: Mapping[str, tuple[InputError, list[Point]]], size: int) -> list[InputError]:
    """Return the errors in reading order; an error that affects only some points names them."""
    explained = []
    for error, points in faults.values():
        if len(points) < size:
            names = "; ".join(dict.fromkeys(point.label for point in points[:NAMED_POINTS]))
            more = f" and {len(points) - NAMED_POINTS} more" if len(points) > NAMED_POINTS else ""
            hint = f"{error.hint}; " if error.hint else ""
            error = InputError(
                error.message, file=error.file, line=error.line, column=error.column, hint=f"{hint}in {names}{more}"
            )
        explained.append(error)
    return in_reading_order(explained)
