"""The frame that reports and sites share: head with title, links and a button for light and dark, then the body."""

from collections.abc import Sequence
from html import escape
from importlib import resources
from importlib.resources.abc import Traversable

from mrpbench_core.report.rules import RULES
from mrpbench_core.report.template import PageTemplate


def page_shell(
    styles: Sequence[Traversable], scripts: Sequence[Traversable], body: str = "<!--body-->", rules: str = ""
) -> PageTemplate:
    """Return a page in which `title`, `links` and the marks of `body` are still to be filled in.

    Args:
        styles: files of CSS.
        scripts: files of JavaScript.
        body: HTML of the page's content.
        rules: further CSS.
    """
    code = {
        "style": "".join(map(_text, styles)) + rules,
        "script": "\n".join(map(_text, scripts)),
        "body": body,
    }
    return PageTemplate(resources.files(__package__) / "template" / "shell.html", code)


def rules_markup() -> str:
    """Return the rules behind the numbers as items of a description list."""
    return "".join(f"<dt>{escape(name)}</dt><dd>{escape(words)}</dd>" for name, words in RULES)


def _text(file: Traversable) -> str:
    return file.read_text(encoding="utf-8")
