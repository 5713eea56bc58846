"""Tables of reports and sites as markup: scripts make them sort, filter and export."""

import re
from collections.abc import Sequence
from html import escape

import attrs


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


def data_table(name: str, heads: Sequence[str], rows: Sequence[Sequence[Td]], identity: str = "") -> str:
    """Return a table whose cells carry their headings, which narrow screens show.

    Args:
        name: of the file in which it is saved.
        heads: plain text.
        rows: all cells of a column have the classes of the first one.
        identity: `id` of the element.
    """
    styles = [cell.style for cell in rows[0]] if rows else [""] * len(heads)
    head = "".join(
        f'<th scope="col"{_attribute("class", style)}>{breakable(text)}</th>'
        for text, style in zip(heads, styles, strict=True)
    )
    body = "".join(
        f"<tr>{''.join(_cell(text, cell) for text, cell in zip(heads, row, strict=True))}</tr>" for row in rows
    )
    return (
        f'<div class="wide"><table class="data"{_attribute("id", identity)}{_attribute("data-name", name)}>'
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
    )


def breakable(name: str) -> str:
    """Return text that may be broken at its dots, slashes and low lines."""
    return re.sub(r"[._/]", r"\g<0><wbr>", escape(name))


def prose(text: str) -> str:
    """Return text whose words in backticks are code."""
    return re.sub("`([^`]+)`", r"<code>\1</code>", escape(text))


def _cell(head: str, cell: Td) -> str:
    value = "" if cell.value is None else f' data-value="{cell.value:.9g}"'
    return f'<td{_attribute("class", cell.style)} data-label="{escape(head)}"{value}>{cell.markup}</td>'


def _attribute(name: str, value: str) -> str:
    return f' {name}="{escape(value)}"' if value else ""
