"""Fills the templates of pages, which load no other file."""

import html
import re
from collections.abc import Mapping
from importlib import resources
from pathlib import Path

from mrpbench_core.files.errors import InputError

FOLDER = resources.files(__package__) / "page"


def write_template(name: str, title: str, parts: Mapping[str, str], file: Path) -> None:
    """Write a page: the template with the common head, where each mark `<!--part-->` is replaced by its text.

    Args:
        name: file name of the template.
        title: title of the page, plain text.
        parts: HTML by mark.
        file: the page.

    Raises:
        InputError: the file cannot be written.
    """
    head, template = ((FOLDER / each).read_text(encoding="utf-8") for each in ("head.html", name))
    parts = {"title": html.escape(title), **parts}
    text = template.replace("<!--head-->", head, 1)
    text = re.sub(r"<!--(\w+)-->", lambda mark: parts[mark[1]], text)  # at once: what is filled in may look like a mark
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None
