"""Reads studies in a worker process, because the classes of plugins check a configuration."""

import os
import sys
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import psutil

from mrpbench_core.config.items import Location, from_data
from mrpbench_core.engine.loading.runs import StudyRuns, unpack_error, unpack_study
from mrpbench_core.engine.processes.child import WorkerDied
from mrpbench_core.engine.processes.slots import ask_in_slot
from mrpbench_core.files.errors import InputError, InputErrors, read_all

READING_S = 3600.0
"""Wall seconds that reading may take."""


def read_study(slots: str, source: Path | str | Mapping[str, Any], overrides: Sequence[str] = ()) -> StudyRuns:
    """Read a configuration in a worker of `slots`; see `mrpbench_core.config.study.load_study`.

    Raises:
        InputErrors, InputError: what is wrong with it; or a plugin ended the process or did not return.
    """
    given = from_data(source, Location()).data if isinstance(source, Mapping) else str(source)
    with tempfile.TemporaryDirectory(prefix="mrpbench-") as folder:
        log = Path(folder, "log.txt")
        job = {"study": given, "overrides": list(overrides), "folder": os.getcwd(), "log": str(log)}  # noqa: PTH109
        limits = {"wall_s": READING_S, "memory_bytes": psutil.virtual_memory().total}
        try:
            answer = ask_in_slot(slots, {**job, **limits})
        except WorkerDied as death:
            raise InputError(f"the configuration cannot be read: {death}") from death
        except (OSError, TypeError, ValueError) as error:
            raise InputError(f"the configuration cannot be read: {error}") from error
        if log.exists():
            sys.stderr.write(log.read_text(errors="replace"))
    if "failure" in answer:
        raise InputError(answer["failure"]["message"])
    try:
        if "errors" in answer["study"]:
            raise InputErrors(*(unpack_error(fault) for fault in answer["study"]["errors"]))
        return unpack_study(answer["study"])
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise InputError(f"a plugin changed how configurations are read: {error}") from error


def read_studies(slots: str, files: Iterable[Path | str], overrides: Sequence[str] = ()) -> list[StudyRuns]:
    """Read several configurations; raise the errors of all of them together."""
    return read_all(lambda file: read_study(slots, file, overrides), files)
