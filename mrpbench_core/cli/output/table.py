"""Prints a table: folded to the width of a terminal, in whole lines elsewhere, or as JSON."""

import json
import shutil
import sys
import textwrap
from collections.abc import Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, Any

from mrpbench_core.files.printing import printable

if TYPE_CHECKING:
    from mrpbench_core.report.tables.table import Table

GAP = 2
"""Blanks between columns."""
NARROW = 8
"""Width below which no column is folded."""


def print_table(columns: Sequence[str], rows: Sequence[Sequence[Any]], title: str = "") -> None:
    """Print rows of cells; None is shown as a dash. Columns of numbers are flush right."""
    columns = list(map(printable, columns))
    cells = [["–" if cell is None else printable(str(cell)) for cell in row] for row in rows]
    right = [all(_is_number(row[index]) for row in cells) for index in range(len(columns))]
    if title:
        print(printable(title))
    lines = [columns, *cells]
    widths = [max(len(line[index]) for line in lines) for index in range(len(columns))]
    if sys.stdout.isatty():
        columns = [name.replace("_", " ").replace(".", " ") for name in columns]
        heads = [max(map(len, name.split()), default=0) for name in columns]  # headings break between words
        widths = [max([head, *(len(row[i]) for row in cells)]) for i, head in enumerate(heads)]
        widths = _fitted(widths, shutil.get_terminal_size().columns)
        _print_row(columns, widths, right)
        print("─" * (sum(widths) + GAP * (len(widths) - 1)))
    else:
        _print_row(columns, widths, right)
    for row in cells:
        _print_row(row, widths, right)


def print_wide(table: "Table") -> None:
    """Print a table with its note; on a terminal that is too narrow, in parts that repeat the first columns."""
    from mrpbench_core.report.tables.table import text

    rows = [[text(cell) for cell in row] for row in table.rows]
    limit = shutil.get_terminal_size().columns if sys.stdout.isatty() else None
    widths = [
        max([len(part) for part in heading.replace("_", " ").replace(".", " ").split()] + [len(row[i]) for row in rows])
        for i, heading in enumerate(table.headings)
    ]
    if not rows:
        print(table.title)
    for number, chosen in enumerate(_parts(widths, table.keys, limit) if rows else ()):
        title = table.title if number == 0 else f"{table.title} (continued)"
        print_table([table.headings[i] for i in chosen], [[row[i] for i in chosen] for row in rows], title)
    print(f"  {table.note}\n")


def _parts(widths: Sequence[int], keys: int, limit: int | None) -> list[list[int]]:
    """Columns of each part, none wider than `limit` if that can be."""
    first = list(range(keys))
    parts = [[*first]]
    for column in range(keys, len(widths)):
        width = sum(widths[i] + GAP for i in (*parts[-1], column))
        if limit is not None and width > limit and len(parts[-1]) > keys:
            parts.append([*first])
        parts[-1].append(column)
    return parts


def _print_row(row: Sequence[str], widths: Sequence[int], right: Sequence[bool]) -> None:
    """Print the cells of a row, each in as many lines as its width needs."""
    folded = [
        textwrap.wrap(cell, width) if len(cell) > width else [cell] for cell, width in zip(row, widths, strict=True)
    ]
    for line in zip_longest(*folded, fillvalue=""):
        parts = (
            cell.rjust(width) if flush else cell.ljust(width)
            for cell, width, flush in zip(line, widths, right, strict=True)
        )
        print((" " * GAP).join(parts).rstrip())


def _fitted(widths: Sequence[int], limit: int) -> list[int]:
    """Widths whose sum with the gaps is at most `limit`, if it can be: the widest columns are narrowed."""
    fitted = list(widths)
    while sum(fitted) + GAP * (len(fitted) - 1) > limit and max(fitted, default=0) > NARROW:
        fitted[fitted.index(max(fitted))] -= 1
    return fitted


def _is_number(cell: str) -> bool:
    return cell == "–" or cell.replace(".", "").replace("e-", "").replace("e+", "").removeprefix("-").isdigit()


def print_json(value: Any) -> None:
    """Print a value as JSON."""
    text = json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False)
    print("".join(c if c.isprintable() or c == "\n" else json.dumps(c)[1:-1] for c in text))
