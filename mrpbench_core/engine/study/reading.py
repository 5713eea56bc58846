"""Reads studies in a worker process, because the classes of plugins check a configuration."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from mrpbench_core.config.items import Location, from_data
from mrpbench_core.engine.loading.runs import StudyRuns, packed_study, unpack_study
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.files.errors import InputError, read_all


def read_study(source: Path | str | Mapping[str, Any], overrides: Sequence[str] = ()) -> StudyRuns:
    """Read a configuration in a worker process; see `mrpbench_core.config.study.load_study`.

    Raises:
        InputErrors, InputError: what is wrong with it; or a plugin ended the process or did not return.
    """
    data = from_data(source, Location()).data if isinstance(source, Mapping) else str(source)
    packed = in_worker("the configuration cannot be read", packed_study, data, list(overrides))
    try:
        return unpack_study(packed)
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise InputError(f"a plugin changed how configurations are read: {error}") from error


def read_studies(files: Iterable[Path | str], overrides: Sequence[str] = ()) -> list[StudyRuns]:
    """Read several configurations; raise the errors of all of them together."""
    return read_all(lambda file: read_study(file, overrides), files)
