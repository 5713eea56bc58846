"""A value that cannot be measured is null with a reason, never 0."""

import attrs
import numpy as np
import pytest

from mrpbench_core.api import Column, Metric
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus
from mrpbench_core.model.runs.run import FinishedRun
from mrpbench_core.referee.measuring import measure


@attrs.frozen(kw_only=True)
class Length(Metric):
    columns = (Column("length_s", "s", "lower", "How long."), Column("odd", "", "neither", "Not a number."))
    requires = frozenset({"time"})

    def measure(self, run):
        return {"length_s": float(run.channel("time")[-1]), "odd": float("nan")}


@attrs.frozen(kw_only=True)
class NeedsPlan(Length):
    requires = frozenset({"plan"})

    def measure(self, run):
        return {"length_s": 1.0}


METRICS = {"length": Length(), "plan": NeedsPlan()}


def test_values_are_named_after_metric_and_column_and_nan_is_null(run_context):
    run = FinishedRun(context=run_context, executed=True, channels={"time": lambda: np.arange(3.0)})
    values, reasons = measure(METRICS, run)
    assert values == {"length.length_s": 2.0, "length.odd": None, "plan.length_s": 1.0, "plan.odd": None}
    assert reasons.keys() == {"length.odd", "plan.odd"}


def test_a_metric_without_its_channel_gives_null_and_the_reason(run_context):
    values, reasons = measure(METRICS, FinishedRun(context=run_context, executed=True))
    assert values["length.length_s"] is None
    assert reasons["length"] == "no time"


def test_without_a_plan_the_reason_says_so(run_context):
    failed = attrs.evolve(run_context, result=attrs.evolve(run_context.result, plan=None))
    values, reasons = measure(METRICS, FinishedRun(context=failed, executed=False))
    assert set(values.values()) == {None}
    assert reasons == {"length": "not executed", "plan": "no plan"}


def test_a_column_without_its_channel_is_null_alone(run_context):
    @attrs.frozen(kw_only=True)
    class Touches(Length):
        columns = (*Length.columns, Column("touches", "", "lower", "How many.", requires=frozenset({"contact"})))

        def measure(self, run):
            return {"length_s": 2.0, "touches": 0}

    run = FinishedRun(context=run_context, executed=True, channels={"time": lambda: np.arange(3.0)})
    values, reasons = measure({"m": Touches()}, run)
    assert values == {"m.length_s": 2.0, "m.odd": None, "m.touches": None}
    assert reasons["m.touches"] == "no contact"


def test_a_recording_without_plans_does_not_count_as_a_failed_plan(run_context):
    @attrs.frozen(kw_only=True)
    class Solved(Length):
        columns = (Column("solved", "", "higher", "Whether."),)
        requires = frozenset()

        def measure(self, run):
            return {"solved": run.context.result.plan is not None}

    foreign = attrs.evolve(run_context, result=PlanResult(status=PlanStatus.UNKNOWN))
    values, reasons = measure({"m": Solved()}, FinishedRun(context=foreign, executed=True))
    assert values == {"m.solved": None}
    assert reasons == {"m": "planned by others"}


@attrs.frozen(kw_only=True)
class Broken(Length):
    returns: object = None
    requires = frozenset()

    def measure(self, run):
        if self.returns is None:
            raise ValueError("no idea")
        return self.returns


def test_a_metric_that_raises_costs_neither_the_run_nor_the_others(run_context):
    run = FinishedRun(context=run_context, executed=True, channels={"time": lambda: np.arange(3.0)})
    values, reasons = measure({"broken": Broken(), **METRICS}, run)
    assert values["broken.length_s"] is None
    assert values["length.length_s"] == 2.0
    assert reasons["broken"] == "the metric raised ValueError: no idea"


def test_values_that_are_not_numbers_are_null_with_the_reason(run_context):
    run = FinishedRun(context=run_context, executed=True)
    text = {"broken": Broken(returns={"length_s": "long", "odd": 1})}
    values, reasons = measure(text, run)
    assert values == {"broken.length_s": None, "broken.odd": 1}
    assert reasons["broken.length_s"] == "the metric returned str instead of a number"


@pytest.mark.parametrize(
    ("returns", "reason"),
    [
        ({"odd": 1}, "returned no value for it"),
        ({"odd": 1, "length_s": float("nan")}, "returned nan, and not None"),
        ({"odd": 1, "length_s": float("inf")}, "returned inf, and not None"),
    ],
)
def test_a_column_that_is_left_out_or_not_finite_is_null_and_the_metric_is_named(run_context, returns, reason):
    values, reasons = measure({"broken": Broken(returns=returns)}, FinishedRun(context=run_context, executed=True))
    assert values == {"broken.length_s": None, "broken.odd": 1}
    assert list(reasons) == ["broken.length_s"]
    assert reasons["broken.length_s"] == f"the metric {reason}"


def test_an_integer_that_records_do_not_hold_is_null(run_context):
    @attrs.frozen(kw_only=True)
    class Vast(Length):
        def measure(self, run):
            return {"length_s": 10**400, "odd": -(2**63)}

    run = FinishedRun(context=run_context, executed=True, channels={"time": lambda: np.arange(3.0)})
    values, reasons = measure({"vast": Vast()}, run)
    assert values == {"vast.length_s": None, "vast.odd": -(2**63)}
    assert reasons["vast.length_s"] == "the metric returned an integer of more than 64 bits"
    _, reasons = measure({"broken": Broken(returns=[1])}, run)
    assert reasons["broken"] == "the metric returned list instead of a mapping"


@attrs.frozen(kw_only=True)
class Error(Metric):
    columns = (
        Column("error_m", "m", "lower", "Between both.", requires=frozenset({"estimate"})),
        Column("rows", "", "neither", "Of one."),
    )
    requires = frozenset({"truth"})

    def measure(self, run):
        return {"error_m": 0.0, "rows": 3.0}


def test_channels_from_one_source_are_not_compared(run_context):
    rows = {"truth": lambda: np.zeros((3, 2, 3)), "estimate": lambda: np.zeros((3, 2, 3))}
    run = FinishedRun(context=run_context, executed=True, channels=rows, alike=(frozenset({"truth", "estimate"}),))
    values, reasons = measure({"error": Error()}, run)
    assert values == {"error.error_m": None, "error.rows": 3.0}
    assert reasons == {"error.error_m": "estimate and truth are from one source"}
