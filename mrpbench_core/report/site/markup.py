"""Tables of a site, which sort, filter and export as those of reports do."""

from collections.abc import Sequence
from html import escape

import attrs

from mrpbench_core.report.html.tables import breakable


@attrs.frozen
class Td:
    """A cell."""

    markup: str
    value: float | None = None
    """Number by which its column is sorted."""
    style: str = ""
    """CSS classes."""


def plain(content: object) -> Td:
    """Return a cell with text, or with a number that sorts as one."""
    if isinstance(content, int | float):
        return Td(f"{content:g}", content, "number")
    return Td(escape(str(content)))


def table_markup(name: str, heads: Sequence[str], rows: Sequence[Sequence[Td]]) -> str:
    """Return a table whose cells carry their headings, which narrow screens show."""
    styles = [cell.style for cell in rows[0]] if rows else [""] * len(heads)
    head = "".join(
        f'<th scope="col"{_class(style)}>{breakable(text)}</th>' for text, style in zip(heads, styles, strict=True)
    )
    body = "".join(
        f"<tr>{''.join(_cell(text, cell) for text, cell in zip(heads, row, strict=True))}</tr>" for row in rows
    )
    return (
        f'<div class="wide"><table class="data" id="{name}" data-name="{name}"><thead><tr>{head}</tr></thead>'
        f"<tbody>{body}</tbody></table></div>"
    )


def _cell(head: str, cell: Td) -> str:
    value = "" if cell.value is None else f' data-value="{cell.value:.9g}"'
    return f'<td{_class(cell.style)} data-label="{escape(head)}"{value}>{cell.markup}</td>'


def _class(style: str) -> str:
    return f' class="{style}"' if style else ""
