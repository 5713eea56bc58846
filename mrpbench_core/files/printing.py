"""Escape text of plugins and of results of others for a terminal, a CSV file and the name of a file."""

import re
from urllib.parse import quote

_FORMULA = tuple("=+-@\t\r\n＝＋－＠")
"""Characters at which spreadsheets begin a formula, also in full width (OWASP, "CSV Injection")."""
_LONGEST = 120
"""Characters of a file name, which must stay below 255 bytes with prefix and suffix."""


def escaped(text: str) -> str:
    """Return text without characters that control a terminal or change the order of letters; lines and tabs stay."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c in "\n\t" else c.encode("unicode_escape").decode() for c in text)


def printable(text: str) -> str:
    """Return text in one line that is safe to print."""
    return escaped(" ".join(text.split()))


def csv_cell(value: object) -> object:
    """Return the value of a cell that no spreadsheet takes for a formula; numbers stay as they are."""
    if value is None or isinstance(value, int | float):
        return value
    text = str(value)
    return f"'{printable(text)}" if text.lstrip().startswith(_FORMULA) and not _is_number(text) else printable(text)


def file_name(text: str) -> str:
    """Return text as a part of a file name: letters, digits and `-_.` stay, everything else becomes `%XX`."""
    name = quote(text, safe="", errors="surrogatepass").replace("~", "%7E")
    return re.sub(r"^\.", "%2E", name)[:_LONGEST]


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", text) is not None
