"""A pytest plugin: records which lines each test executes, or runs the chosen tests in the order of a list.

With `MUTANTS_RECORD`, a folder, it measures coverage with one context per test. A process that a test starts counts for
all tests of its file, because it may serve several; what a shared fixture executes counts for all tests that use it.
With `MUTANTS_TESTS`, a file of node ids, it runs only these.
"""

import json
import os
import time
from collections.abc import Generator
from pathlib import Path
from typing import Any

import coverage
import pytest

FIXTURE, FILE = "fixture ", "file "
"""How a context begins that is not one test."""


class Recorder:
    """Measures coverage; it begins before the tests are collected."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._coverage = coverage.Coverage(config_file=str(folder / "coveragerc"))
        self._coverage.start()
        self._now = "import"
        self._tests: dict[str, dict[str, Any]] = {}

    @pytest.hookimpl(hookwrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Generator[None]:
        """Give the test its context and note the time of the CPU."""
        shared = sorted({_name(fixtures[-1]) for fixtures in _fixtures(item) if fixtures[-1].scope != "function"})
        test = self._tests[item.nodeid] = {"passed": True, "fixtures": shared}
        before, began = self._switch(item.nodeid, FILE + item.nodeid.partition("::")[0]), _spent()
        wall = time.monotonic()
        yield
        test["cpu"], test["wall"] = round(_spent() - began, 3), round(time.monotonic() - wall, 3)
        self._switch(before, "")
        if len(self._tests) % 100 == 0:
            self._write()

    @pytest.hookimpl(hookwrapper=True)
    def pytest_fixture_setup(self, fixturedef: Any) -> Generator[None]:
        """Give a fixture that several tests share its own context."""
        if fixturedef.scope == "function":
            yield
            return
        before = self._switch(_name(fixturedef), _name(fixturedef))
        yield
        self._switch(before, FILE + before.partition("::")[0])

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note a failure."""
        self._tests[report.nodeid]["passed"] &= not report.failed

    def pytest_sessionfinish(self) -> None:
        """Save what was measured."""
        self._coverage.stop()
        self._coverage.save()
        self._write()

    def _write(self) -> None:
        (self._folder / "measured.json").write_text(json.dumps(self._tests, indent=0))

    def _switch(self, context: str, of_children: str) -> str:
        self._coverage.switch_context(context)
        self._coverage.config.context = of_children
        os.environ["COVERAGE_PROCESS_CONFIG"] = self._coverage.config.serialize()
        before, self._now = self._now, context
        return before


class Chooser:
    """Runs only the listed tests, in that order."""

    def __init__(self, tests: list[str]) -> None:
        self._place = {test: place for place, test in enumerate(tests)}

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Leave out all others."""
        chosen = [item for item in items if item.nodeid in self._place]
        items[:] = sorted(chosen, key=lambda item: self._place[item.nodeid])


def pytest_configure(config: pytest.Config) -> None:
    """Record, or choose."""
    if folder := os.environ.pop("MUTANTS_RECORD", None):
        config.pluginmanager.register(Recorder(Path(folder)))
    if chosen := os.environ.pop("MUTANTS_TESTS", None):
        config.pluginmanager.register(Chooser(json.loads(Path(chosen).read_text())))


def _fixtures(item: pytest.Item) -> list[Any]:
    return [*item._fixtureinfo.name2fixturedefs.values()] if hasattr(item, "_fixtureinfo") else []


def _name(fixture: Any) -> str:
    return f"{FIXTURE}{fixture.baseid}::{fixture.argname}"


def _spent() -> float:
    """CPU seconds of this process and of those that it waited for."""
    return sum(os.times()[:4])
