"""The first instances of the soaks, and what the soaks would say of a planner that is wrong."""

import runpy
from pathlib import Path

import attrs
import pytest
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_tests.soak import run

from mrpbench_core.model.planning.plan import PlanStatus

PLANNING, ASSIGNING = (
    runpy.run_path(str(Path(__file__).with_name(f"soak_{name}.py")))["SOAK"] for name in ("planners", "assigning")
)


@pytest.mark.parametrize(("soak", "count"), [(PLANNING, 24), (ASSIGNING, 24)])
def test_nothing_is_wrong_with_the_first_instances(soak, count, capsys):
    assert run(soak, count, seed=1) == 0
    printed = capsys.readouterr().out
    assert f"{count} instances from number 0 of seed 1: 0 faults" in printed
    assert "unsolvable" in printed


def test_one_cost_too_many_is_noticed(capsys):
    def too_low(asked):
        optimum = PLANNING.optimum(asked)
        return None if optimum is None else optimum - 1

    assert run(PLANNING._replace(optimum=too_low), 8, seed=1) > 0
    assert "lower bound" in capsys.readouterr().out


def test_without_the_oracle_planners_are_compared_with_one_another(capsys):
    @attrs.frozen(kw_only=True)
    class Denying(Cbs):
        def plan(self, problem, budget):
            return attrs.evolve(super().plan(problem, budget), status=PlanStatus.UNSOLVABLE, plan=None)

    soak = PLANNING._replace(optimum=lambda asked: None, planners=lambda random: [Cbs(), Denying()])
    assert run(soak, 8, seed=1) > 0
    assert "says unsolvable, but Cbs" in capsys.readouterr().out
