"""The recording and the record of an execution, for each kind of end."""

import re

import numpy as np
import pytest

from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.files.errors import InputError
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording

RUN = {
    "world": "office",
    "scenario": {"plugin": "random", "robots": 3},
    "assigner": "identity",
    "planner": "example",
    "limits": {"execution": "8 s"},
}
FORMATS = """
import errno
from pathlib import Path

import attrs

from mrpbench_core.api import FormatWriter, WritableFormat, option
from mrpbench_core.files.errors import InputError


class Session(FormatWriter):
    def __init__(self, file, fails):
        self.file, self.fails = file, fails
        file.touch()

    def write(self, chunk):
        if self.fails == "write":
            raise ValueError("not this time: write")

    def close(self):
        if self.fails == "close":
            raise ValueError("not this time: close")
        if self.fails == "exit":
            raise SystemExit("not this time: exit")
        self.file.write_text("closed")

    def abandon(self):
        self.file.unlink()


@attrs.frozen(kw_only=True)
class Fine(WritableFormat):
    def open(self, context, destination):
        return Session(destination, None)


@attrs.frozen(kw_only=True)
class Broken(WritableFormat):
    when: str = option("open", help="it fails")

    def open(self, context, destination):
        if self.when == "open":
            raise ValueError("not this time: open")
        if self.when == "full":
            raise OSError(errno.ENOSPC, "no space left")
        if not self.when:
            raise InputError("no such place")
        return Session(destination, self.when)
"""


FLAT = """
import attrs

from mrpbench_core.builtin.simulators.kinematic import Kinematic


@attrs.frozen(kw_only=True)
class Flat(Kinematic):
    def open(self, world, fleet, placements, seed, period, movers=(), levels=None):
        return super().open(world, fleet, placements, seed, period, movers)
"""

CLAIMING = """
import attrs
import numpy as np
from mrpbench_core.api.navigator import Navigator, NavigatorSession
from mrpbench_core.model.execution.motion import Mode, Motion


@attrs.frozen(kw_only=True)
class Claiming(Navigator):
    def start(self, fleet, world, routes, controller, period, seed):
        return Standing()


class Standing(NavigatorSession):
    def adopt(self, routes, cut):
        raise AssertionError

    def step(self, now, observation, orders):
        done, count = orders.released, len(orders.released)
        mode = np.full(count, Mode.WAITING, "u1")
        return Motion(twist=np.zeros((count, 2)), reached=done, cleared=done, mode=mode)
"""


def executed(tmp_path, **changes):
    (point,) = load_study({**RUN, **changes}).runs
    paths = RunPaths(recording=tmp_path / "recordings" / "run.zip", exports=tmp_path / "exports")
    return execute(point.config, point.run_id, paths, lambda stage, facts: None).message()


def test_a_robot_held_back_is_recorded_without_a_command(tmp_path):
    executed(tmp_path, noise={"start_jitter": "5 s"})
    recording = Recording(tmp_path / "recordings" / "run.zip")
    time, command = recording.channel("time"), recording.channel("command")
    recording.close()
    delay = np.array([Seeds(0).stream("start_jitter", robot).uniform(0, 5) for robot in range(3)])
    assert not command[time[:, None] < delay].any()
    assert command[time[:, None] > delay + 1].any()


def test_the_error_of_an_aborted_run_names_robots_that_gave_up_and_the_cause(tmp_path):
    impatient = {"movement_time_allowance": 0.5, "required_movement_radius": 9.0, "max_recoveries": 0}
    record = executed(tmp_path, navigator={"plugin": "waypoints", **impatient})
    assert record["status"] == "execution_aborted"
    assert record["error"]["message"].startswith(
        "a robot gave up before all had arrived: robot_0: no_progress; robot_1"
    )


def test_a_robot_that_is_said_to_have_arrived_and_has_not_is_named_with_its_distance(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "claiming.py").write_text(CLAIMING)
    record = executed(tmp_path, scenario={"plugin": "random", "robots": 1}, navigator="./claiming.py:Claiming")
    assert record["status"] == "goals_missed"
    says = r"the navigator reports that robot 0 arrived, but robot 0 is \d+\.\d\d m from its goal"
    assert re.fullmatch(says, record["error"]["message"])


@pytest.mark.parametrize(
    ("limit", "status", "message"),
    [
        ("1 s", "goals_missed", "not all robots arrived within 1 simulated seconds: robot_0 stopped for good"),
        ("1.05 s", "execution_aborted", "not all robots can arrive: robot_0 stopped for good at 1.0 s"),
    ],
)
def test_a_run_that_a_fault_ends_is_aborted_unless_its_time_is_over(tmp_path, limit, status, message):
    faults = {"events": [{"kind": "stop", "robot": 0, "at": "1 s"}]}
    record = executed(tmp_path, scenario={"plugin": "random", "robots": 1}, faults=faults, limits={"execution": limit})
    assert record["status"] == status
    assert record["error"]["message"].startswith(message)


@pytest.mark.parametrize("floor", [1, 2])
def test_a_simulator_that_ignores_levels_is_refused_where_robots_start_on_upper_ones(tmp_path, monkeypatch, floor):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "flat.py").write_text(FLAT)
    places = {"starts": [f"L{floor}_south_1"], "goals": [f"L{floor}_south_25"]}
    hospital = {"world": "hospital", "roadmap": "graph", "scenario": {"plugin": "named", **places}}
    record = executed(tmp_path, **hospital, planner="prioritized", simulator="./flat.py:Flat")
    refused = "the simulator supports the lowest level only, and robots start on other levels"
    message = record["error"]["message"]
    assert message == refused if floor == 2 else message.startswith("not all robots arrived within 8")


@pytest.mark.parametrize("when", ["open", "write", "close", "exit"])
def test_an_export_that_fails_is_named_and_costs_nothing_else(tmp_path, monkeypatch, when):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "formats.py").write_text(FORMATS)
    whole = executed(tmp_path)
    broken = {"plugin": "./formats.py:Broken", "when": when}
    record = executed(tmp_path, export=[broken, {"plugin": "./formats.py:Fine"}])
    (name,) = record["unexported"]
    assert "Broken" in name
    assert record["unexported"][name].endswith(f"not this time: {when}")
    assert (record["status"], record["metrics"]) == (whole["status"], whole["metrics"])
    assert whole["unexported"] == {}
    (file,) = (tmp_path / "exports").iterdir()
    assert file.name.endswith("Fine")
    assert file.read_text() == "closed"


def test_a_full_disk_fails_the_run_and_not_one_export_alone(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "formats.py").write_text(FORMATS)
    with pytest.raises(OSError, match="no space left"):
        executed(tmp_path, export=[{"plugin": "./formats.py:Fine"}, {"plugin": "./formats.py:Broken", "when": "full"}])
    assert list((tmp_path / "recordings").iterdir()) == []
    assert list((tmp_path / "exports").iterdir()) == []


def test_an_option_of_a_format_that_does_not_fit_is_the_users_to_mend(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "formats.py").write_text(FORMATS)
    with pytest.raises(InputError, match="no such place"):
        executed(tmp_path, export=[{"plugin": "./formats.py:Fine"}, {"plugin": "./formats.py:Broken", "when": ""}])
    assert list((tmp_path / "recordings").iterdir()) == []
    assert list((tmp_path / "exports").iterdir()) == []
