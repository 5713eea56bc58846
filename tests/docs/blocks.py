"""The blocks of code of a page, and what each is for.

- The text before a block names the file that the block is: "Save this as `mine.py`:".
- `*Tested by …*` before a block says what else runs it, `*Not tested: reason.*` why nothing does.
- Other blocks in `sh` and `python` are run, those in `yaml` are parts of a configuration, and a block of `text` after a
  block in `sh` is its output, in which `...` stands for anything. A block without a language is a drawing.
"""

import re
from collections.abc import Iterator
from pathlib import Path

import attrs

FENCE = re.compile(r"^(?P<indent> *)```(?P<language>\w*)\n(?P<code>.*?)^(?P=indent)```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"\bas\s+`([\w./-]+)`[^`]*:\Z")
REASON = re.compile(r"^\*(?:Not tested:|Tested by) (.+)\*\Z", re.MULTILINE)


@attrs.frozen
class Block:
    """One block of code of a page."""

    language: str
    code: str
    line: int
    """Line of the page on which the code begins, from 1."""
    file: str | None
    """The file that the block is, relative to the folder of the reader."""
    reason: str | None
    """Why it does not run here: what else runs it, or why nothing can."""


def blocks_of(page: Path) -> Iterator[Block]:
    """The blocks of a page in order, without directives of Sphinx."""
    text = page.read_text(encoding="utf-8")
    for fence in FENCE.finditer(text):
        before = text[: fence.start()].rstrip()
        file, reason = FILE.search(before.rpartition("\n\n")[2]), REASON.search(before)
        yield Block(
            language=fence["language"],
            code=fence["code"],
            line=text.count("\n", 0, fence.start("code")) + 1,
            file=file and file[1],
            reason=reason and reason[1],
        )
