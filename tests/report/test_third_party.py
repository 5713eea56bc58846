"""A metric that no code of this project names goes through a run, a report and a replay."""

import json
import os
import re
import subprocess
import sys

import pytest

from mrpbench_core.report.html.page import write_report
from mrpbench_core.report.report import make_report
from mrpbench_core.store.results import load

METRIC = """
from typing import ClassVar

import attrs
from mrpbench_core.api import Column, Metric

@attrs.frozen(kw_only=True)
class Strain(Metric):
    columns: ClassVar = (
        Column("wear_mm", "mm", "lower", "metres that all robots <drove>", primary=True, drawn="cactus"),
        Column("hidden", "", "higher", "the number of robots"),
    )
    requires: ClassVar = frozenset({"truth"})

    def measure(self, run):
        return {"wear_mm": 2.0, "hidden": len(run.context.fleet)}
"""
STUDY = """
name: tried
world: {plugin: movingai, file: tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 1}
assigner: identity
planner: astar
simulator: kinematic
metrics: [planning, execution, strain]
matrix: {planner: [astar, prioritized], seed: 0..1}
"""


@pytest.fixture(scope="module")
def reported(tmp_path_factory):
    """Run, report and view in processes in which the metric is installed; return the folder and what was printed."""
    folder = tmp_path_factory.mktemp("third")
    info = folder / "site" / "acme_strain-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: acme-strain\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[mrpbench.metrics]\nstrain = acme_strain:Strain\n")
    (folder / "site" / "acme_strain.py").write_text(METRIC)
    (folder / "tiny.map").write_text("type octile\nheight 3\nwidth 3\nmap\n...\n...\n...\n")
    (folder / "study.yaml").write_text(STUDY)

    def mrpbench(*words):
        done = subprocess.run(
            [sys.executable, "-m", "mrpbench_core.cli.main", *words],
            capture_output=True,
            text=True,
            cwd=folder,
            env=os.environ | {"PYTHONPATH": str(folder / "site")},
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    printed = mrpbench("run", "study.yaml", "--out", "out"), mrpbench("report", "out", "--replays", "1")
    return folder / "out", *printed


def test_the_summary_of_a_run_has_its_primary_column(reported):
    _, summary, _ = reported
    (row,) = (line.split() for line in summary.splitlines() if line.startswith("strain."))
    assert row == ["strain.wear_mm", "2", "2"]


def test_tables_figures_and_the_list_of_runs_have_its_primary_column(reported):
    folder, _, tables = reported
    assert "strain.wear_mm" in tables
    assert "strain.hidden" not in tables
    page = (folder / "report.html").read_text()
    charts = re.findall(r'<svg class="chart"[^>]* aria-label="([^"]*)"', page)
    assert [chart for chart in charts if "strain" in chart] == [
        "strain.wear_mm",
        "scenarios succeeded by strain.wear_mm",
        "share of scenarios by strain.wear_mm, ratio to the best",
    ]


def test_the_replay_has_its_primary_column(reported):
    folder, _, _ = reported
    (replay,) = folder.glob(f"replay-{'?' * 12}.html")
    data = re.search(r'<script type="application/json" id="run">(.*?)</script>', replay.read_text(), re.DOTALL)
    metrics = {metric.pop("name"): metric for metric in json.loads(data[1])["facts"]["metrics"]}
    assert metrics["strain.wear_mm"]["primary"] == metrics["execution.duration_s"]["primary"] == "execution"
    assert metrics["strain.wear_mm"]["text"] == "metres that all robots <drove>"
    assert "primary" not in metrics["strain.hidden"]


def test_a_folder_describes_columns_whose_metric_is_not_installed(reported, tmp_path):
    folder, _, _ = reported
    found = make_report([load(folder)])
    (column,) = (column for column in found.columns if column.name == "strain.wear_mm")
    assert (column.unit, column.better, column.drawn) == ("mm", "lower", "cactus")
    write_report(found, tmp_path / "report.html")
    assert "scenarios succeeded by strain.wear_mm" in (tmp_path / "report.html").read_text()
