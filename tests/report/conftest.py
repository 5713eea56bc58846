"""Results folders made of records that tests write by hand."""

import json
import re
from html.parser import HTMLParser

import pytest

from mrpbench_core.store.results import load

INVOCATION = """\
columns:
  planning.cost: {unit: s, better: lower, description: what it costs, source: ''}
  execution.duration_s: {unit: s, better: lower, description: how long, source: ''}
"""


def made(planner="cbs", seed=0, status="succeeded", *, repeat=0, cost=None, took=1.0, **more):
    """A record; `scenario` and others replace its entries, `config` adds to its configuration."""
    config = {
        "planner": {"plugin": planner},
        "scenario": {"plugin": "random", "robots": 5},
        "limits": {"planning": 10.0, "wall": 1800.0},
        "seed": seed,
        "repeat": repeat,
        "name": "x",
        "metrics": {},
    } | more.pop("config", {})
    planned = status in ("succeeded", "goals_missed", "execution_aborted")
    return {
        "run_id": re.sub(
            r"[^\w-]", "", f"{planner}-{seed}-{repeat}-{config['scenario']['robots']}-{more.pop('tag', '')}"
        ),
        "scenario_id": more.pop("scenario", f"scenario-{seed}"),
        "attempt": 1,
        "config": config,
        "seed": seed,
        "repeat": repeat,
        "status": status,
        "metrics": {"planning.solved": planned, "planning.cost": cost},
        "timing": {"planning_s": took, "clock_bound": False},
        "provenance": {},
    } | more


VOID = {"meta", "link", "input", "wbr", "line", "br"}


class Parsed(HTMLParser):
    """Notes text, attributes, and elements that are not closed in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.wrong, self.attributes, self.words = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.attributes += [(tag, *pair) for pair in attributes]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.attributes += [(tag, *pair) for pair in attributes]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)

    def handle_data(self, data):
        self.words.append(data)


@pytest.fixture(scope="session")
def parsed():
    """Return a function that reads a page."""
    return Parsed


@pytest.fixture(scope="session")
def written():
    """Return a function that writes records into a results folder and loads it."""

    def write(records, folder, invocation=INVOCATION):
        (folder / "runs").mkdir(parents=True, exist_ok=True)
        (folder / "invocations").mkdir(exist_ok=True)
        (folder / "invocations" / "1.yaml").write_text(invocation)
        lines = "".join(json.dumps(record) + "\n" for record in records)
        (folder / "runs" / "1.jsonl").write_text(lines)
        return load(folder)

    return write


@pytest.fixture
def results(tmp_path, written):
    """Return a function that does so in a folder of this test."""

    def write(records, name="results", invocation=INVOCATION):
        return written(records, tmp_path / name, invocation)

    return write


@pytest.fixture(scope="session")
def record():
    """Return a function that makes a record."""
    return made


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""
