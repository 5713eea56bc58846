"""The streams on which commands print: what a plugin or a record says cannot control the terminal.

Everything that is printed passes `files.printing.escaped`. Only `unescaped` gives the stream below, for the sequences
that this package writes itself.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO

from mrpbench_core.files.printing import escaped

ERASE_LINE = "\r\x1b[K"


class EscapedStream:
    """A text stream that escapes what it writes, and is otherwise the stream below."""

    def __init__(self, below: TextIO) -> None:
        self.below = below

    def write(self, text: str) -> int:
        """Write text without control characters."""
        self.below.write(escaped(text))
        return len(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.below, name)


@contextmanager
def escaped_output() -> Iterator[None]:
    """Escape what is printed on standard output and standard error."""
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = map(EscapedStream, before)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before


def unescaped() -> TextIO:
    """The stream below standard output."""
    below: TextIO = getattr(sys.stdout, "below", sys.stdout)
    return below
