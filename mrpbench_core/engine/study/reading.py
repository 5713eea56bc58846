"""Reads studies in a worker process, because the classes of plugins check a configuration."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import psutil

from mrpbench_core.config.items import Location, from_data
from mrpbench_core.engine.loading.runs import StudyRuns, packed_study, unpack_study
from mrpbench_core.engine.processes.call import CallFailedError, call
from mrpbench_core.files.errors import InputError, read_all

READING_S = 3600.0
"""Wall seconds that reading may take."""


def read_study(slots: str, source: Path | str | Mapping[str, Any], overrides: Sequence[str] = ()) -> StudyRuns:
    """Read a configuration in a worker of `slots`; see `mrpbench_core.config.study.load_study`.

    Raises:
        InputErrors, InputError: what is wrong with it; or a plugin ended the process or did not return.
    """
    given = from_data(source, Location()).data if isinstance(source, Mapping) else str(source)
    memory = psutil.virtual_memory().total
    try:
        found = call(slots, packed_study, given, list(overrides), limit_s=READING_S, memory_bytes=memory)
    except CallFailedError as failure:
        raise InputError(f"the configuration cannot be read: {failure}") from failure
    try:
        return unpack_study(found)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise InputError(f"a plugin changed how configurations are read: {error}") from error


def read_studies(slots: str, files: Iterable[Path | str], overrides: Sequence[str] = ()) -> list[StudyRuns]:
    """Read several configurations; raise the errors of all of them together."""
    return read_all(lambda file: read_study(slots, file, overrides), files)
