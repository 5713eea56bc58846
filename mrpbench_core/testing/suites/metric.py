"""Checks that every metric must pass."""

import math
from collections.abc import Mapping

from mrpbench_core.api.metric import Column, Metric, Value
from mrpbench_core.checking.recording import LAYOUTS
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.testing.faults import Skip, require
from mrpbench_core.testing.fixtures.finished_run import context, finished, permuted
from mrpbench_core.testing.suites.component import ComponentConformance


class MetricConformance(ComponentConformance):
    """Checks of metrics: `class TestMine(MetricConformance)`."""

    def make(self) -> Metric:
        """Return the metric to check."""
        raise NotImplementedError("define make(self) and return the metric to check")

    def test_describes_its_columns(self) -> None:
        columns = self.make().columns
        require(
            columns and all(isinstance(column, Column) for column in columns),
            "`columns` is not a tuple of at least one `Column`",
        )
        names = [column.name for column in columns]
        require(len(set(names)) == len(names), f"two columns have one name: {names}")
        for column in columns:
            require(
                column.better in ("lower", "higher", "neither"), f"column {column.name}: better is {column.better!r}"
            )
            require(column.description, f"column {column.name} has no description")
            require(
                column.drawn == "interval" or column.better == "lower",
                f"column {column.name}: `drawn` is {column.drawn!r}, which is for columns of which less is better",
            )
            require(
                column.threshold is None or column.threshold >= 0,
                f"column {column.name}: `threshold` is {column.threshold!r}; a difference that matters is at least 0",
            )
            require(
                0 <= column.threshold_share < 1,
                f"column {column.name}: `threshold_share` is {column.threshold_share!r}; it is a share, such as 0.05",
            )

    def test_requires_channels_that_exist(self) -> None:
        metric = self.make()
        required = metric.requires.union(*(column.requires for column in metric.columns))
        unknown = sorted(required - {*LAYOUTS, "plan", "path", "end"})
        require(not unknown, f"requires channels that no recording has: {', '.join(unknown)}")

    def test_gives_exactly_its_columns(self) -> None:
        metric = self.make()
        names, wanted = set(measured(metric, finished())), {column.name for column in metric.columns}
        require(names <= wanted, f"returns values that `columns` does not declare: {', '.join(sorted(names - wanted))}")
        require(wanted <= names, f"returns no value (None is one) for: {', '.join(sorted(wanted - names))}")

    def test_needs_no_channel_that_it_does_not_require(self) -> None:
        metric = self.make()
        measured(metric, finished(sorted(metric.requires)))

    def test_measures_a_run_that_was_not_executed(self) -> None:
        metric = self.make()
        if metric.requires - {"plan"}:
            raise Skip("it requires a recording")
        measured(metric, FinishedRun(context=context(), executed=False))

    def test_measures_a_run_without_a_plan(self) -> None:
        metric = self.make()
        if metric.requires:
            raise Skip(f"it requires {', '.join(sorted(metric.requires))}")
        measured(metric, FinishedRun(context=context(PlanResult(status=PlanStatus.TIMEOUT)), executed=False))

    def test_measures_the_same_again(self) -> None:
        one, other = measured(self.make(), finished()), measured(self.make(), finished())
        require(one == other, f"returns other values the second time: {differences(one, other)}")

    def test_does_not_depend_on_the_order_of_robots(self) -> None:
        metric = self.make()
        one, other = measured(metric, finished()), measured(metric, permuted((2, 0, 1)))
        differing = differences(one, other)
        require(not differing, f"the values depend on the order of robots: {differing}")


def measured(metric: Metric, run: FinishedRun) -> Mapping[str, Value]:
    """The metric's values, each a finite number, a bool or None."""
    values = metric.measure(run)
    for name, value in values.items():
        right = value is None or isinstance(value, bool | int | float)
        require(right, f"column {name} is {value!r}, a {type(value).__name__}: return float, int, bool or None")
        finite = not isinstance(value, float) or math.isfinite(value)
        require(finite, f"column {name} is {value}: return None for what cannot be measured")
    return values


def differences(one: Mapping[str, Value], other: Mapping[str, Value]) -> str:
    """Columns that differ by more than rounding, in words."""
    return ", ".join(
        f"{name} {one[name]} and {other.get(name)}" for name in one if not close(one[name], other.get(name))
    )


def close(one: Value, other: Value) -> bool:
    """Tell whether two values are equal up to rounding."""
    if one is None or other is None:
        return one is other
    return math.isclose(one, other, rel_tol=1e-9, abs_tol=1e-9)
