"""The contract of metrics, checked for each metric of this package."""

import mrpbench_metrics_standard as ours
import pytest

from mrpbench_core.testing.faults import Skip
from mrpbench_core.testing.suites.metric import MetricConformance

CHECKS = [name for name in dir(MetricConformance) if name.startswith("test_")]


@pytest.mark.parametrize("check", CHECKS)
@pytest.mark.parametrize("name", ours.__all__)
def test_keeps_the_contract_of_metrics(name, check):
    class Suite(MetricConformance):
        def make(self):
            return getattr(ours, name)()

    try:
        getattr(Suite(), check)()
    except Skip as reason:
        pytest.skip(str(reason))
