import sys
from pathlib import Path

import numpy as np
import pytest
from mrpbench_policies.acting import load
from mrpbench_policies.observations import PogemaDefault

from mrpbench_core.api import InputError

OBSERVATION = PogemaDefault(2)


def policy(tmp_path, body):
    file = tmp_path / "policy.py"
    file.write_text(body)
    return load(file, OBSERVATION, (8, 8))


RETURNS = """\
class Policy:
    def __init__(self, robots, seed):
        pass

    def act(self, observations):
        return {}
"""


@pytest.mark.parametrize("value", ["[1, 4]", "[[1], [4]]", "[[0, 9, 0, 0, 0], [0, 0, 0, 0, 9]]"])
def test_a_class_returns_actions_or_scores(tmp_path, value):
    acting = policy(tmp_path, RETURNS.format(value))
    acting.begin(2, 0)
    assert acting.act({}).argmax(axis=1).tolist() == [1, 4]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("class Policy\n", "is not Python"),
        ("class Agent:\n    pass\n", "defines no class `Policy` with a method `act`"),
        (RETURNS.format("[1, 5]"), "returned action 5 for robot_1, not 0 to 4"),
        (RETURNS.format("[1]"), r"returned int64 \[1\], not scores \[2, 5\] or actions \[2\]"),
        (RETURNS.format("[0.5, 1.0]"), "returned actions of float64, not of integers"),
        (RETURNS.format("['a', 'b']"), "not numbers"),
        (RETURNS.format("[[0, 0, 0, 0, float('nan')]] * 2"), "returned NaN as a score of robot_0"),
    ],
)
def test_what_is_no_policy_is_refused_in_one_line(tmp_path, body, message):
    with pytest.raises(InputError, match=message):
        first_step(tmp_path, body)


def first_step(tmp_path, body):
    acting = policy(tmp_path, body)
    acting.begin(2, 0)
    acting.act({"observation": np.zeros((2, 3, 5, 5))})


def test_another_interpreter_runs_a_file_that_needs_its_own_environment(tmp_path):
    file = tmp_path / "policy.py"
    file.write_text(
        "import os\n\nimport numpy as np\n\n"
        "class Policy:\n"
        "    def __init__(self, robots, seed):\n        self.calls = seed\n"
        "    def act(self, observations):\n"
        "        print('not an answer')\n        os.write(1, b'nor this')\n        self.calls += 1\n"
        "        observations['observation'][:] = 0\n"
        "        return np.full(len(observations['observation']), self.calls % 5)\n"
    )
    acting = load(file, OBSERVATION, (8, 8), Path(sys.executable))
    rows = {"observation": np.zeros((2, 3, 5, 5), np.float32)}
    acting.begin(2, 1)
    assert [acting.act(rows).argmax(axis=1).tolist() for _ in range(2)] == [[2, 2], [3, 3]]
    acting.begin(2, 0)
    assert acting.act(rows).argmax(axis=1).tolist() == [1, 1]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("import nothing_of_that_name\n", r"policy\.py:1: ModuleNotFoundError: No module named"),
        ("class Policy\n", "SyntaxError: expected ':'"),
        ("class Agent:\n    pass\n", "defines no class `Policy`"),
        (RETURNS.format("1 / 0"), r"policy\.py:6: ZeroDivisionError: division by zero"),
        ("import os\n" + RETURNS.format("os._exit(3)"), "its process ended with exit code 3"),
        ("import os\n" + RETURNS.format("os.kill(os.getpid(), 11)"), "its process ended with SIGSEGV"),
        ("import sys\n" + RETURNS.format("sys.exit('enough')"), "its process ended with exit code 1: enough"),
        (RETURNS.format("[7, 7]"), "returned action 7 for robot_0"),
    ],
)
def test_what_goes_wrong_in_another_interpreter_is_one_line(tmp_path, body, message):
    file = tmp_path / "policy.py"
    file.write_text(body)
    with pytest.raises(InputError, match=message):
        in_process(file)


def in_process(file):
    acting = load(file, OBSERVATION, (8, 8), Path(sys.executable))
    acting.begin(2, 0)
    acting.act({"observation": np.zeros((2, 3, 5, 5))})


def test_an_interpreter_that_does_not_run_is_named(tmp_path):
    (tmp_path / "policy.py").write_text(RETURNS.format("[0]"))
    with pytest.raises(InputError, match=r"none/python: does not run: No such file"):
        load(tmp_path / "policy.py", OBSERVATION, (8, 8), Path("none/python"))


REMEMBERS = """\
from __future__ import annotations

import pickle
from dataclasses import dataclass

import numpy as np


@dataclass
class Settings:
    action: int


class Policy:
    def __init__(self, robots, seed, weights):
        with open(weights) as file:
            self.settings = pickle.loads(pickle.dumps(Settings(int(file.read()))))
        self.memory = {"steps": np.zeros((robots, 1))}

    def act(self, observations):
        self.memory["steps"] = self.memory["steps"] + 1
        return (self.settings.action + self.memory["steps"][:, 0]).astype(int)
"""


@pytest.mark.parametrize("python", [None, Path(sys.executable)])
def test_a_class_reads_its_weights_and_remembers_by_robots(tmp_path, python):
    (tmp_path / "policy.py").write_text(REMEMBERS)
    (tmp_path / "weights.txt").write_text("1")
    acting = load(tmp_path / "policy.py", OBSERVATION, (8, 8), python, tmp_path / "weights.txt")
    acting.begin(2, 0)
    assert acting.act({}).argmax(axis=1).tolist() == [2, 2]
    assert acting.memory["steps"].tolist() == [[1], [1]]
    memory = acting.memory
    acting.begin(2, 0)
    assert acting.memory["steps"].tolist() == [[0], [0]]
    acting.memory = {"steps": memory["steps"] * [[1], [2]]}
    assert acting.act({}).argmax(axis=1).tolist() == [3, 4]
