"""Fills the templates of pages. A page loads no other file, and runs the scripts of this package only.

The Content-Security-Policy of a page (W3C, CSP Level 3) allows the scripts and styles of its template by their SHA-256
and forbids all others, all requests, and forms. It is computed before the data of runs are filled in.
"""

import html
import re
from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256
from importlib.resources.abc import Traversable
from pathlib import Path

from mrpbench_core.files.output import write_page_file

_HEAD = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="mrpbench">
<link rel="icon" href="data:,">
<title>{title}</title>
"""
_ELEMENT = re.compile(r"<(script|style)([^>]*)>(.*?)</\1>", re.DOTALL)
_MARK = re.compile(r"<!--(\w+)-->")


class PageTemplate:
    """The body of a page with the scripts and styles of this package, in which data are still to be filled in."""

    def __init__(
        self, file: Traversable, code: Mapping[str, str] | None = None, frames: "PageTemplate | None" = None
    ) -> None:
        """Read a template.

        Args:
            file: HTML from the head on, with marks `<!--name-->`.
            code: text of scripts and styles by mark.
            frames: template of the pages that this page shows in frames.
        """
        self._text = _fill(file.read_text(encoding="utf-8"), code or {}, keep=True)
        self._allowed = _hashes(self._text)
        for kind, hashes in (frames._allowed if frames else {}).items():
            self._allowed[kind] = sorted({*self._allowed[kind], *hashes})

    @property
    def policy(self) -> str:
        """The Content-Security-Policy. `strict-dynamic` allows the modules that an allowed script imports."""
        sources = {
            kind: " ".join(f"'sha256-{digest}'" for digest in digests) for kind, digests in self._allowed.items()
        }
        return (
            f"default-src 'none'; script-src {sources['script']} 'strict-dynamic'; style-src {sources['style']};"
            " img-src data:; base-uri 'none'; form-action 'none'"
        )

    def write(self, file: Path, title: str, parts: Mapping[str, str]) -> None:
        """Write a page.

        Args:
            file: the page.
            title: plain text.
            parts: HTML by mark.

        Raises:
            InputError: the file cannot be written.
        """
        escaped = html.escape(title)
        body = _fill(self._text, {"title": escaped, **parts})
        write_page_file(file, _HEAD.format(policy=self.policy, title=escaped) + body)

    def wrote(self, file: Path) -> bool:
        """Tell whether a page has this template's policy before anything else, so that it runs no other script."""
        begin = _HEAD.partition("<meta name")[0].format(policy=self.policy).encode()
        try:
            if not file.is_file():
                return False
            with file.open("rb") as stream:
                return stream.read(len(begin)) == begin
        except OSError:
            return False


def _fill(text: str, parts: Mapping[str, str], *, keep: bool = False) -> str:
    """Replace all marks at once, since what is filled in may look like a mark; `keep` those without a part."""
    return _MARK.sub(lambda mark: parts.get(mark[1], mark[0]) if keep else parts[mark[1]], text)


def _hashes(text: str) -> dict[str, list[str]]:
    """The SHA-256 of each script and each style; elements of data are not scripts."""
    digests: dict[str, list[str]] = {"script": [], "style": []}
    for kind, attributes, content in _ELEMENT.findall(text):
        if "application/" not in attributes:
            digests[kind].append(b64encode(sha256(content.encode()).digest()).decode())
    return digests
