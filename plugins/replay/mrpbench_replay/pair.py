"""Writes two replays side by side, with one clock, as one HTML page that loads no other file."""

import html
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from mrpbench_core.report.template import PageTemplate
from mrpbench_replay.write_page import FOLDER, template


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
    pair_template().write(file, " and ".join(titles), {"frames": "\n".join(frames)})


@cache
def pair_template() -> PageTemplate:
    """The template of these pages. Frames are subject to the policy of their page too."""
    return PageTemplate(FOLDER / "pair.html", frames=template())
