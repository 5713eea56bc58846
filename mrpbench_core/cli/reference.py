"""`RUN` on the command line: `DIR:PREFIX` of a run id, or `DIR` if it holds one run."""

from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.results import Results, load

HELP = "DIR:PREFIX of the run id, or DIR if it holds one run"


def find_run(text: str) -> tuple[Results, dict[str, Any]]:
    """The results a run is in, and its record.

    Raises:
        InputError: there is no such run, or several.
    """
    folder, prefix = (text, "") if Path(text).is_dir() else (text.rpartition(":")[0] or text, text.rpartition(":")[2])
    results = load(folder)
    try:
        return results, results[prefix]
    except KeyError as error:
        ids = " ".join(record["run_id"] for record, _ in zip(results, range(5), strict=False))
        hint = f"as DIR:PREFIX; there are {ids} …" if ids else "it is empty"
        raise InputError(f"{text}: {error.args[0]}", hint=hint) from None
