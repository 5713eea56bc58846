"""The pages tell the truth: a reader who does what a page says, in an empty folder, finds that it works."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
FOLLOWED_ELSEWHERE = {"planner-native", "planner-external"}
"""Pages that need a compiler or other programs; tests in `tests/cli` follow them."""
SLOW = {
    "charging", "critic", "league-of-robot-runners", "lifelong", "my-map", "other-simulators", "people", "policies",
    "publish", "real-fleet", "replays", "slam",
}  # fmt: skip
"""Long pages of what comes after the first hour: `make pages` follows them, `make test` all others."""
PAGES = [
    page
    for part in ("tutorial", "how-to", "reference", "explanation")
    for page in sorted((ROOT / "docs" / part).rglob("*.md"))
    if "\n```" in page.read_text() and page.stem not in FOLLOWED_ELSEWHERE
]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: f"{page.parent.name}/{page.stem}")
def test_what_a_page_says_works(page, tmp_path):
    if page.stem in SLOW and "MRPBENCH_ALL_PAGES" not in os.environ:
        pytest.skip("`make pages` follows this page")
    site, folder, home = tmp_path / "site", tmp_path / "folder", tmp_path / "home"
    for made in (site, folder, home):
        made.mkdir()
    environment = os.environ | {
        "PATH": f"{HERE}{os.pathsep}{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": f"{folder}{os.pathsep}{site}",
        "PYTHONDONTWRITEBYTECODE": "1",
        "SITE": str(site),
        "HOME": str(home),
        "CHECKOUT": str(ROOT),
        "COLUMNS": "120",
    }
    done = subprocess.run(
        [sys.executable, HERE / "reader.py", page], cwd=folder, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
