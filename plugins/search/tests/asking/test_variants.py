"""Options of runs that a search changes."""

from mrpbench_search.asking.variants import patched

CONFIG = {
    "seed": 1,
    "controller": {
        "plugin": "dwb",
        "sim_time": 1.7,
        "critics": [{"plugin": "PathDist", "scale": 32.0}, {"scale": 1.0}],
    },
}


def test_options_are_changed_where_their_steps_lead_and_nothing_else():
    changes = {"seed": 2, "controller.sim_time": 2.0, "controller.critics.0.scale": 8.0, "controller.new": True}
    critics = [{"plugin": "PathDist", "scale": 8.0}, {"scale": 1.0}]
    expected = {"seed": 2, "controller": {"plugin": "dwb", "sim_time": 2.0, "critics": critics, "new": True}}
    assert patched(CONFIG, changes) == expected
    assert patched(CONFIG, {"seed": 1}) == CONFIG
    assert CONFIG["controller"]["critics"][0]["scale"] == 32.0
