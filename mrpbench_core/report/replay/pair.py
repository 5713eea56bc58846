"""Writes two replays side by side, with one clock, as one HTML page that loads no other file."""

import html
from collections.abc import Sequence
from importlib import resources
from pathlib import Path

from mrpbench_core.files.errors import InputError


def write_pair(replays: Sequence[Path], titles: Sequence[str], file: Path) -> None:
    """Write one page with two replays; the robot selected in one is selected in the other.

    Args:
        replays: the two pages, as `write_page` writes them.
        titles: the name of each run.
        file: the page.

    Raises:
        InputError: the file cannot be written.
    """
    frames = [
        f'<iframe title="{html.escape(title)}" srcdoc="{html.escape(page.read_text(encoding="utf-8"))}"></iframe>'
        for page, title in zip(replays, titles, strict=True)
    ]
    text = (resources.files(__package__) / "page" / "pair.html").read_text(encoding="utf-8")
    text = text.replace("<!--title-->", html.escape(" and ".join(titles)), 1)
    text = text.replace("<!--frames-->", "\n".join(frames), 1)
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None
