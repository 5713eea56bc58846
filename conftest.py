"""Fixtures that every test folder shares."""

import secrets
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings
from mrpbench_tests.fixtures.corridor_run import corridor, new_plan, robot_model, run_context  # noqa: F401 - fixtures

from mrpbench_core.cli.main import main
from mrpbench_core.engine.processes import slots

# The same examples in every run, so that a change is judged by what it changes; `make explore` draws others.
settings.register_profile("mrpbench", deadline=None, derandomize=True)  # a busy machine is no defect
settings.register_profile("explore", deadline=None, print_blob=True)
settings.load_profile("mrpbench")

MAP = "type octile\nheight 3\nwidth 3\nmap\n...\n...\n...\n"
STUDY = """\
name: tiny
world: {plugin: movingai, file: tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 2}
assigner: identity
planner: example
simulator: none
metrics: []
matrix:
  seed: 0..1
"""
FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


@pytest.fixture(autouse=True, scope="session")
def slow_machine() -> Iterator[None]:
    """Let planners be late by a second in checks of their deadlines: machines differ by a factor of five."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mrpbench_core.testing.suites.planner.LATE_S", 1.0)
        yield


@pytest.fixture(scope="session")
def worker_slots() -> Iterator[str]:
    """Worker slots that modules share."""
    key = secrets.token_hex(8)
    yield key
    slots.close_slots(key)


@pytest.fixture(scope="module")
def kept_workers(worker_slots: str) -> Iterator[None]:
    """Keep worker processes for all studies of a module, since starting them costs more than most runs."""
    token = slots._OPEN.set(worker_slots)
    yield
    slots._OPEN.reset(token)


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Public maps and reference costs next to the checkout; tests that need them skip where they are absent."""
    folder = Path(__file__).parent.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("the public reference data are not next to the checkout")
    return folder


@pytest.fixture(scope="session")
def tiny_map() -> str:
    """Return nine free cells as a MovingAI map."""
    return MAP


@pytest.fixture(scope="session")
def tiny_study() -> str:
    """Return a study of two robots on it, once for each of two seeds."""
    return STUDY


@pytest.fixture
def mrpbench(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., tuple[int, str, str]]:
    """Return a function that runs a command in a folder with a tiny study and gives exit code, output and errors."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tiny.map").write_text(MAP)
    (tmp_path / "tiny.yaml").write_text(STUDY)

    def invoke(*words: object) -> tuple[int, str, str]:
        try:
            code = main([str(word) for word in words])
        except SystemExit as end:
            code = int(end.code or 0)
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return invoke


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """Return headless Chromium with a window of 1280 by 800 pixels; skips where there is none."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="the tests of the page in a browser need selenium")
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if chromium is None or driver is None:
        pytest.skip("the tests of the page in a browser need chromium and chromedriver")
    options = webdriver.ChromeOptions()
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(flag)
    options.binary_location = chromium
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    found = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))
    screen = {"width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False}
    found.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
    yield found
    found.quit()
