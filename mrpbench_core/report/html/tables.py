"""Tables as markup: folded, and on narrow screens a block of lines for each row."""

import re
from html import escape

from mrpbench_core.files.text import counted
from mrpbench_core.report.tables.table import Cell, Shown, Table, text


def table_markup(table: Table) -> str:
    """Return a table that unfolds; scripts make it sort, filter and export."""
    note = f'<p class="note">{escape(table.note)}</p>'
    if not table.rows:
        return f"<details><summary>{escape(table.title)}</summary>{note}</details>"
    heads = "".join(f'<th scope="col"{_kind(table, i)}>{breakable(name)}</th>' for i, name in enumerate(table.headings))
    rows = "".join(f"<tr>{''.join(_cell(table, i, cell) for i, cell in enumerate(row))}</tr>" for row in table.rows)
    return (
        f"<details><summary>{escape(table.title)} <span>{counted(len(table.rows), 'row')}</span></summary>{note}"
        f'<div class="wide"><table class="data" data-name="{escape(table.key)}"><thead><tr>{heads}</tr></thead>'
        f"<tbody>{rows}</tbody></table></div></details>"
    )


def breakable(name: str) -> str:
    """Return text that may be broken at its dots, slashes and low lines."""
    return re.sub(r"[._/]", r"\g<0><wbr>", escape(name))


def _cell(table: Table, column: int, cell: Cell) -> str:
    """A cell with its heading, which narrow screens show, and its number, by which it is sorted."""
    label = f' data-label="{escape(table.headings[column])}"'
    number = cell.estimate.value if isinstance(cell, Shown) else cell if isinstance(cell, int | float) else None
    sort = "" if number is None or number != number else f' data-value="{number:.9g}"'
    value, bracket, interval = text(cell).partition(" [")
    small = (
        f" <small>[{escape(interval)}</small>" if bracket and isinstance(cell, Shown) else escape(bracket + interval)
    )
    return f"<td{_kind(table, column)}{label}{sort}>{escape(value)}{small}</td>"


def _kind(table: Table, column: int) -> str:
    return "" if column < table.keys else ' class="number"'
