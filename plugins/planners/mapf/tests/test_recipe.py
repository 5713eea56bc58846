"""Options of planners follow from what C++ says about their algorithms."""

from importlib.metadata import entry_points

import attrs
import pytest
from mrpbench_native import describe, options_of
from mrpbench_planners_mapf.bounded import Eecbs
from mrpbench_planners_mapf.cbs import Cbs
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_planners_mapf.recipe import NativePlanner, RobustPlanner

PLANNERS = {
    point.name: point.load()
    for point in entry_points(group="mrpbench.planners")
    if point.value.startswith("mrpbench_planners_mapf") and point.name != "token_passing"  # no search of its own
}


@pytest.mark.parametrize("name", sorted(PLANNERS))
def test_a_planner_has_the_name_and_defaults_of_its_algorithm(name):
    planner = PLANNERS[name]
    assert issubclass(planner, NativePlanner)
    assert planner.algorithm == name
    native = {option: default for option, default in options_of(name).items() if option != "seed"}
    fields = {field.name: field.default for field in attrs.fields(planner) if field.name in native}
    assert fields.items() <= native.items()
    assert all(field.metadata["help"] for field in attrs.fields(planner))


def test_what_the_name_decides_is_no_option():
    assert "goal_choice" not in attrs.fields_dict(Cbs)
    assert "iterations" not in attrs.fields_dict(Lacam)
    assert [field.name for field in attrs.fields(PLANNERS["ecbs"])] == [*attrs.fields_dict(RobustPlanner), "w"]
    assert {option.name for option in describe("ecbs").options} == {option.name for option in describe("eecbs").options}


@pytest.mark.parametrize("wrong", [{"w": 0.5}, {"w": 1e10}, {"incumbent_after": -1}, {"conflict_weight": float("nan")}])
def test_ranges_hold_before_planning(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Eecbs(**wrong)
    with pytest.raises(ValueError, match="objective"):
        Lacam(objective="cost")
