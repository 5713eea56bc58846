"""A run on the command line: `DIR:PREFIX` with a prefix of its id, or `DIR` if the folder has one run."""

from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.results import Results, load

HELP = "DIR:PREFIX with a prefix of the run id, or DIR if the folder has only one run"


def find_run(text: str) -> tuple[Results, dict[str, Any]]:
    """Return the results that contain a run, and its record.

    Raises:
        InputError: there is no such run, or several.
    """
    folder, prefix = (text, "") if Path(text).is_dir() else (text.rpartition(":")[0] or text, text.rpartition(":")[2])
    results = load(folder)
    try:
        return results, results[prefix]
    except KeyError as error:
        ids = " ".join(record["run_id"] for record, _ in zip(results, range(5), strict=False))
        hint = f"write DIR:PREFIX; there are {ids} …" if ids else "the folder has no runs"
        raise InputError(f"{text}: {error.args[0]}", hint=hint) from None
