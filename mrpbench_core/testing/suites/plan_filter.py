"""Checks that every plan filter must pass, on random paths."""

import numpy as np

from mrpbench_core.api.plan_filter import PlanFilter
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.suites.component import ComponentConformance


class PlanFilterConformance(ComponentConformance):
    """Checks of plan filters: `class TestMine(PlanFilterConformance)`."""

    def make(self) -> PlanFilter:
        """Return the plan filter to check."""
        raise NotImplementedError("define make(self) and return the plan filter to check")

    def test_keeps_both_ends_of_every_path(self) -> None:
        random, steps = np.random.default_rng(0), np.array([(1, 0), (0, 1), (-1, 0), (0, -1), (0, 0)])
        for length in range(1, 30):
            waypoint = 0.4 * np.cumsum(steps[random.integers(0, 5, length)], axis=0)
            before = waypoint.copy()
            kept = np.asarray(self.make().keep(waypoint))
            require(kept.dtype == bool, f"keep returns {kept.dtype} instead of bool")
            require(kept.shape == (length,), f"keep returns shape {kept.shape} for {length} waypoints")
            require(bool(kept[0] and kept[-1]), "drops the start or the end of a path")
            require(np.array_equal(waypoint, before), "changes the waypoints that it is given")
