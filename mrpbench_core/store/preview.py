"""Some records as a table in text."""

import shutil
from collections.abc import Mapping, Sequence
from typing import Any

from mrpbench_core.files.printing import printable

_ID = 12
"""Characters of a run id; commands accept any unique prefix."""
_SAMPLES = ("config.name", "config.seed", "config.repeat")


def preview(rows: Sequence[Mapping[str, Any]], metrics: Sequence[str]) -> list[str]:
    """Return the lines of a table with the options that differ, and as many metrics as the terminal is wide.

    Args:
        rows: flat records, at least one.
        metrics: names of columns.
    """
    options = [key for key in rows[0] if key.startswith("config.") and key not in _SAMPLES]
    differing = [key for key in options if len({repr(row.get(key, row)) for row in rows}) > 1]
    shared = [key for key in differing if all(key in row for row in rows)]
    columns = {"run": [row["run_id"][:_ID] for row in rows]}
    columns |= {key.removeprefix("config."): [row[key] for row in rows] for key in shared}
    columns |= {key: [row.get(key) for row in rows] for key in ("seed", "status", *metrics)}
    width = shutil.get_terminal_size((120, 24)).columns
    lines = [""] * (len(rows) + 1)
    for name, values in columns.items():
        cells = [printable(name), *map(_written, values)]
        wide = max(map(len, cells))
        if len(lines[0]) + wide > width:
            break
        if all(value is None or isinstance(value, int | float) for value in values):
            cells = [cell.rjust(wide) for cell in cells]
        lines = [f"{line}{cell:{wide}}  " for line, cell in zip(lines, cells, strict=True)]
    return [line.rstrip() for line in lines]


def _written(value: Any) -> str:
    if value is None:
        return "–"
    return f"{value:.4g}" if isinstance(value, float) else printable(str(value))
