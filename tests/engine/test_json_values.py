"""Return values of plugins become JSON values."""

import enum
import json

import numpy as np

from mrpbench_core.engine.json_values import jsonable


class Colour(enum.StrEnum):
    RED = "red"


def test_everything_becomes_json():
    value = {
        1: np.float64(1.5),
        "i": np.int32(3),
        "b": np.bool_(True),
        "a": np.array([[1.0, np.nan]]),
        "n": (float("inf"), -float("inf"), None, True),
        "e": Colour.RED,
        "o": Ellipsis,
        "w": [2**63 - 1, 2**63, -(10**400)],
        "d": {"x": frozenset()},
    }
    expected = {
        "1": 1.5,
        "i": 3,
        "b": True,
        "a": [[1.0, None]],
        "n": [None, None, None, True],
        "e": "red",
        "o": "Ellipsis",
        "w": [2**63 - 1, None, None],
        "d": {"x": "frozenset()"},
    }
    assert json.loads(json.dumps(jsonable(value), allow_nan=False)) == expected


def test_text_that_no_file_can_hold_is_escaped():
    found = jsonable({"\ud800": "Größe \udcff\n"})
    assert found == {"\\ud800": "Größe \\udcff\n"}
    json.dumps(found, ensure_ascii=False).encode()
