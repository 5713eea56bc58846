"""The report of a load, from the events of a recording."""

import json
from types import SimpleNamespace

import numpy as np
from mrpbench_live.commands.load_report import LoadReport

from mrpbench_core.api import Fleet, RobotModel

BOX = [(0.2, 0.15), (-0.2, 0.15), (-0.2, -0.15), (0.2, -0.15)]
STEP = {
    "begin": 0.0,
    "end": 180.0,
    "offered": 10,
    "done": 9,
    "open": 1,
    "offered_per_hour": 200.0,
    "done_per_hour": 180.0,
    "order_s": [1.0, 2.0, 3.0],
    "done_s": None,
    "starved": 0.1,
    "stuck": 0,
    "cpu": None,
    "memory": 25_000_000,
    "kept_up": True,
}


class Recorded:
    def __init__(self, robots, events):
        columns = zip(*events, strict=True)
        self.channels = {
            f"event_{name}": lambda column=column: np.array(column)
            for name, column in zip(("time", "kind", "robot", "detail"), columns, strict=True)
        }
        self._fleet = Fleet(robots=(RobotModel(name="box", footprint=BOX, max_speed=1.0, max_turn_rate=1.0),) * robots)
        self.channels |= {
            "time": lambda: np.zeros(1),
            "truth": lambda: np.zeros((1, robots, 3)),
            "level": lambda: np.zeros((1, robots), np.int16),
            "contact_time": lambda: np.zeros(0),
            "contact": lambda: np.zeros((0, 2), np.int32),
        }

    def first_context(self):
        return SimpleNamespace(fleet=self._fleet)


def steps(*kept):
    found = []
    for number, kept_up in enumerate(kept):
        place = {"begin": 180.0 * number, "end": 180.0 * (number + 1), "offered_per_hour": 200.0 * 2**number}
        found.append((180.0 * (number + 1), "load_step", -1, json.dumps(STEP | place | {"kept_up": kept_up})))
    return found


def test_the_knee_is_the_last_rate_that_is_kept_up():
    contacts = [(at, "contact", 0, "robot_1") for at in (1.0, 179.0, 200.0)]
    report = LoadReport.of(Recorded(0, steps(True, True, False) + contacts))
    assert report.answer() == "it keeps up with 400 transports per hour, and falls behind at 800"
    assert [row[5] for row in report.rows()] == [2, 1, 0]
    assert report.rows()[0][6:] == [0, 1.0, 2.0, 3.0, None, None, 25, "yes"]
    assert len(report.rows()[0]) == len(LoadReport.COLUMNS)
    assert "the first rate" in LoadReport.of(Recorded(0, steps(False))).answer()
    assert "the last rate" in LoadReport.of(Recorded(0, steps(True))).answer()


def test_a_robot_that_never_drove_says_what_is_missing():
    events = [
        (0.0, "connection", 0, "ONLINE"),
        (1.0, "order_accepted", 0, "a 0"),
        (2.0, "node_traversed", 0, "n1"),
        (0.0, "connection", 1, "ONLINE"),
        (1.0, "order_accepted", 1, "b 0"),
        (0.0, "connection", 2, "ONLINE"),
        (1.0, "refused", 2, "UNKNOWN_MAP_ID: no map is called 'x'"),
        (0.0, "connection", 3, "ONLINE"),
    ]
    report = LoadReport.of(Recorded(5, events))
    assert report.silent == [
        "robot_1 has an order and never left its first node: its base is no longer, or it is held",
        "robot_2 refused every order: UNKNOWN_MAP_ID: no map is called 'x'",
        "robot_3 got no order",
        "robot_4 was never connected",
    ]
    assert report.answer() == "no step is complete: raise limits.execution"
