"""Make the picture of the documentation, a replay in headless Chromium: `python scripts/replay_picture.py`.

It needs chromium, chromedriver and selenium.
"""

import shutil
import tempfile
import time
from pathlib import Path

from selenium import webdriver

from mrpbench_core import run
from mrpbench_core.cli.main import main as mrpbench

PICTURE = Path(__file__).parents[1] / "docs/images/replay.png"
STUDY = {
    "name": "hospital",
    "world": "hospital",
    "scenario": {"plugin": "random", "robots": 6},
    "roadmap": "graph",
    "planner": "eecbs",
}
MOMENT = "replay.clock.seek(20); replay.shown.set({ level: 2 }); replay.shown.setLayer('gantt')"
"""A robot waits for another one to pass, and lifts are on their way."""
FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars")


def main() -> None:
    """Do the run and take the picture."""
    with tempfile.TemporaryDirectory() as folder:
        run(STUDY, out=folder)
        page = Path(folder) / "replay.html"
        mrpbench(["view", folder, "--out", str(page)])
        options = webdriver.ChromeOptions()
        for flag in FLAGS:
            options.add_argument(flag)
        options.binary_location = shutil.which("chromium") or ""
        browser = webdriver.Chrome(options=options, service=webdriver.ChromeService(shutil.which("chromedriver")))
        try:
            screen = {"width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False}
            browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
            browser.get(page.as_uri())
            while not browser.execute_script("return document.body.classList.contains('ready')"):
                time.sleep(0.05)
            browser.execute_script(MOMENT)
            time.sleep(1)
            browser.save_screenshot(str(PICTURE))
        finally:
            browser.quit()


if __name__ == "__main__":
    main()
