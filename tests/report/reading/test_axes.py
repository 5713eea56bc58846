"""The options in which configurations differ."""

import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.report.reading.axes import find_axes, name_axes

CBS, ECBS = {"plugin": "cbs"}, {"plugin": "ecbs", "w": 1.2}


def config(planner, **more):
    return {"planner": planner, "seed": 3, "name": "x", **more}


def test_options_that_only_follow_from_the_plugin_are_left_out():
    assert find_axes([config(CBS), config(ECBS)]) == [{"planner.plugin": "cbs"}, {"planner.plugin": "ecbs"}]


def test_an_option_that_varies_within_a_plugin_stays():
    axes = find_axes([config(CBS), config(ECBS), config({**ECBS, "w": 1.5})])
    assert [entry.get("planner.w") for entry in axes] == [None, 1.2, 1.5]


def test_a_plain_option_that_varies_stays():
    axes = find_axes([config(CBS, control_rate=20.0), config(CBS, control_rate=10.0)])
    assert axes == [{"control_rate": 20.0}, {"control_rate": 10.0}]


def test_differences_between_samples_of_one_configuration_are_not_an_axis():
    assert find_axes([config(CBS), config(CBS) | {"seed": 4, "repeat": 1, "name": "y"}]) == [{}, {}]


def test_a_missing_stage_is_an_axis_and_its_options_are_not():
    without = config(CBS, simulator="none", dispatcher="none")
    driven = config(CBS, simulator={"plugin": "kinematic"}, dispatcher={"plugin": "adg"})
    assert find_axes([without, driven]) == [{"simulator.plugin": "none"}, {"simulator.plugin": "kinematic"}]
    assert name_axes({"simulator.plugin": "none"}) == "none"


def test_rows_can_be_made_by_some_options_only():
    configs = [config(CBS, scenario={"robots": 5}), config(ECBS, scenario={"robots": 9})]
    assert find_axes(configs, ["planner"]) == [{"planner.plugin": "cbs"}, {"planner.plugin": "ecbs"}]
    assert find_axes(configs, ["scenario.robots"]) == [{"scenario.robots": 5}, {"scenario.robots": 9}]
    for name, hint in (
        ("planer", "did you mean 'planner'"),
        ("robots", "did you mean 'scenario.robots'"),
        ("zzz", r"\(options that vary: planner.plugin, scenario.robots\)"),
    ):
        with pytest.raises(InputError, match=hint):
            find_axes(configs, [name])


def test_blocks_in_lists_show_the_options_in_which_blocks_of_a_name_differ():
    def walkers(people, size, **more):
        return {"plugin": "social_force", "people": people, "group_size": size, "radius": 0.25, **more}

    carts = {"plugin": "carts", "people": 2, "radius": 0.45}
    levels = [(), [walkers(6, 1)], [walkers(18, 2), carts], [walkers(6, 1), walkers(6, 1)]]
    axes = find_axes([config(CBS, crowds=crowds) for crowds in levels])
    assert [name_axes(entry) for entry in axes] == [
        "crowds=[]",
        "crowds=[social_force[people=6,group_size=1]]",
        "crowds=[social_force[people=18,group_size=2],carts]",
        "crowds=[social_force[people=6,group_size=1],social_force[people=6,group_size=1]]",
    ]


def test_axes_are_named_in_few_words():
    assert name_axes({"planner.plugin": "ecbs", "planner.w": 1.2, "scenario.robots": 9}) == "ecbs w=1.2 robots=9"
    assert name_axes({"fleet": [{"robot": "burger", "count": 2}]}) == "fleet=[burger[count=2]]"


def test_a_block_with_a_label_is_named_by_it_alone():
    one, other = ({"plugin": "external", "label": label, "binary": label} for label in ("EECBS", "LaCAM3"))
    axes = find_axes([config(CBS), config(one), config(other)])
    assert [name_axes(entry) for entry in axes] == ["cbs", "EECBS", "LaCAM3"]


def test_options_of_blocks_that_share_a_label_are_shown():
    one, other = ({"plugin": "external", "label": "mine", "w": w} for w in (1.2, 1.5))
    assert [entry["planner.w"] for entry in find_axes([config(one), config(other)])] == [1.2, 1.5]


def test_blocks_without_a_label_are_shown_as_before():
    plain = {"plugin": "external", "label": "", "w": 1.2}
    axes = find_axes([config(plain), config({**plain, "w": 1.5})])
    assert [name_axes(entry) for entry in axes] == ["w=1.2", "w=1.5"]
