"""How the runs of a study are done: the keywords of `run` and the options of `mrpbench run`."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import attrs

from mrpbench_core.api.executor import ExecutorSource
from mrpbench_core.config.items import Location, from_data
from mrpbench_core.config.structure import structure_component
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.engine.study.progress import StudyProgress
from mrpbench_core.engine.study.selection import Rerun, read_shard_option
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins.installed import CORE, providers


def _at_least_one(_options: Any, _field: Any, workers: int) -> None:
    if workers < 1:
        raise InputError(f"workers: at least 1, got {workers}")


def _executor(chosen: str | Mapping[str, Any]) -> ExecutorSource:
    """The executor. It works in this process, so its module is tried in a worker before."""
    name = chosen if isinstance(chosen, str) else chosen.get("plugin")
    if not any(provider.name == name and provider.distribution == CORE for provider in providers(ExecutorSource.group)):
        in_worker(f"executor {name!r} cannot be used", tried, chosen)
    return _structured(chosen)


def tried(chosen: str | Mapping[str, Any]) -> None:
    """In a worker process: import an executor and read its options."""
    _structured(chosen)


def _structured(chosen: str | Mapping[str, Any]) -> ExecutorSource:
    block = from_data(chosen, Location())
    return structure_component(ExecutorSource, block, "executor", Path.cwd())  # type: ignore[type-abstract]


@attrs.frozen(kw_only=True)
class StudyOptions:
    """The options of an invocation, which are no part of the configuration.

    Raises:
        InputErrors, InputError: an option is wrong.
    """

    overrides: Sequence[str] = ()
    """Overrides of the configuration, `key=value`."""
    out: Path | None = attrs.field(default=None, converter=attrs.converters.optional(Path))
    """Results folder; by default `results/<name>` in the working directory."""
    workers: int = attrs.field(default=1, validator=_at_least_one)
    """Largest number of runs at a time."""
    executor: ExecutorSource = attrs.field(default="processes", converter=_executor)  # type: ignore[assignment]
    """Where runs execute: a name, or a block with `plugin` and options."""
    shard: tuple[int, int] | None = attrs.field(default=None, converter=attrs.converters.optional(read_shard_option))
    """`"i/n"`: only part i (from 0) of n."""
    rerun: Rerun | None = None
    """Also repeat runs that failed, whose versions or sources changed, or all."""
    progress: StudyProgress = attrs.field(factory=StudyProgress)
    """Receives the progress of the study."""

    def folder_of(self, name: str) -> Path:
        """Return the results folder of the study `name`."""
        return Path("results") / name if self.out is None else self.out
