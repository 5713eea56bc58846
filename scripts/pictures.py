"""Make the pictures of the documentation with headless Chromium: `python scripts/pictures.py`.

The study of the tutorial is the one on its page.
"""

import re
import subprocess
import tempfile
from pathlib import Path

import yaml

from mrpbench_core import run
from mrpbench_core.cli.main import main as mrpbench

DOCS = Path(__file__).parents[1] / "docs"
HOSPITAL = {
    "name": "hospital",
    "world": "hospital",
    "scenario": {"plugin": "random", "robots": 6},
    "roadmap": "graph",
    "planner": "eecbs",
}
LIFTS = "replay.clock.seek(20); replay.shown.set({ level: 2 }); replay.shown.setLayer('gantt')"
"""A robot waits for another one to pass, and lifts are on their way."""
TUTORIAL_RUN = "e23b"
WAITING = "replay.clock.seek(25); replay.shown.setLayer('gantt')"
"""robot_2 waits for robot_0."""


def main() -> None:
    """Do the runs and take the pictures."""
    images = DOCS / "images"
    with tempfile.TemporaryDirectory() as folder:
        hospital, first, page = Path(folder) / "hospital", Path(folder) / "first", Path(folder) / "replay.html"
        run(HOSPITAL, out=hospital)
        mrpbench(["view", str(hospital), "--out", str(page)])
        take(page, images / "replay.png", LIFTS)
        study = re.search(r"```yaml\n(.*?)```", (DOCS / "tutorial/index.md").read_text(), re.DOTALL)
        assert study is not None
        run(yaml.safe_load(study[1]), out=first)
        mrpbench(["world", "office", "--render", str(images / "tutorial-world.png")])
        mrpbench(["report", str(first)])
        take(first / "report.html", images / "tutorial-report.png")
        mrpbench(["view", f"{first}:{TUTORIAL_RUN}", "--out", str(page)])
        take(page, images / "tutorial-replay.png", WAITING)


def take(page: Path, picture: Path, moment: str = "") -> None:
    """Take a picture of a page; `moment` leads a replay, when it is ready, to what is to be seen."""
    text = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page.read_text(encoding="utf-8"))
    script = f"setTimeout(() => {{ {moment} }}, 1000)"
    page.write_text(f"{text}<script>{script}</script>", encoding="utf-8")
    size = ("--window-size=1280,800", "--virtual-time-budget=3000", "--hide-scrollbars")
    flags = ("--headless", "--no-sandbox", "--disable-gpu", *size, f"--screenshot={picture}")
    subprocess.run(["chromium", *flags, page.as_uri()], check=True, capture_output=True)


if __name__ == "__main__":
    main()
