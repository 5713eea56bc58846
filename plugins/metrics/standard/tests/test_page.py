"""The page of metrics says what the metrics say, and every metric can be named in a configuration."""

import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import mrpbench_metrics_standard as ours
import pytest

from mrpbench_core.api import Metric

CHECKOUT = Path(__file__).parents[4]


def test_the_page_is_up_to_date():
    script, written = CHECKOUT / "scripts" / "metrics_page.py", CHECKOUT / "docs/reference/metrics/index.md"
    if not script.is_file():
        pytest.skip("the plugin stands outside its checkout")
    printed = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True).stdout
    assert printed == written.read_text(), "run: python scripts/metrics_page.py > docs/reference/metrics/index.md"


def test_every_metric_is_an_entry_point():
    named = {entry.value for entry in entry_points(group=Metric.group)}
    assert {f"{ours.__name__}:{name}" for name in ours.__all__} <= named
