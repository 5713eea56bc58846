"""The pages of metrics say what the metrics say, and every metric can be named in a configuration."""

import runpy
from importlib.metadata import entry_points
from pathlib import Path

import mrpbench_metrics_standard as ours
import pytest

from mrpbench_core.api import Metric

CHECKOUT = Path(__file__).parents[4]


def test_the_pages_are_up_to_date():
    script, folder = CHECKOUT / "scripts/metrics_page.py", CHECKOUT / "docs/reference/metrics"
    if not script.is_file():
        pytest.skip("the plugin stands outside its checkout")
    written = {file.name: file.read_text(encoding="utf-8") for file in folder.iterdir()}
    assert written == runpy.run_path(str(script))["pages"](), "run: python scripts/metrics_page.py"


def test_every_metric_is_an_entry_point():
    named = {entry.value for entry in entry_points(group=Metric.group)}
    assert {f"{ours.__name__}:{name}" for name in ours.__all__} <= named
