"""Tables of reports as markup: folded, and on narrow screens a block of lines for each row."""

from html import escape

from mrpbench_core.files.text import counted
from mrpbench_core.report.html.cells import Td, data_table
from mrpbench_core.report.tables.table import Cell, Shown, Table, text


def table_markup(table: Table) -> str:
    """Return a table that unfolds; scripts make it sort, filter and export."""
    note = f'<p class="note">{escape(table.note)}</p>'
    if not table.rows:
        return f"<details><summary>{escape(table.title)}</summary>{note}</details>"
    rows = [[_cell(cell, "" if i < table.keys else "number") for i, cell in enumerate(row)] for row in table.rows]
    return (
        f"<details><summary>{escape(table.title)} <span>{counted(len(table.rows), 'row')}</span></summary>{note}"
        f"{data_table(table.key, table.headings, rows)}</details>"
    )


def _cell(cell: Cell, style: str) -> Td:
    """A cell with its number, by which it is sorted."""
    number = cell.estimate.value if isinstance(cell, Shown) else cell if isinstance(cell, int | float) else None
    value, bracket, interval = text(cell).partition(" [")
    small = (
        f" <small>[{escape(interval)}</small>" if bracket and isinstance(cell, Shown) else escape(bracket + interval)
    )
    return Td(escape(value) + small, None if number is None or number != number else number, style)
