"""The first executions of the soaks, and what they would say of components that are wrong."""

import runpy
from pathlib import Path

import attrs
import pytest

from mrpbench_core.builtin.dispatchers.all_at_once import AllAtOnce
from mrpbench_core.builtin.dispatchers.timed import Timed, TimedSession
from mrpbench_core.engine.execution.task_board import TaskBoard

pytest.importorskip("mrpbench_planners_mapf")
SOAK, TASKS = (runpy.run_path(str(Path(__file__).with_name(f"soak_{it}.py"))) for it in ("executions", "tasks"))


@pytest.fixture
def few(monkeypatch):
    monkeypatch.setitem(SOAK["run"].__globals__, "DRAWS", {"at once": 20, "copied": 2, "slow": 1})


def test_all_robots_arrive_in_the_first_executions(few, capsys):
    assert SOAK["run"](200, 1) == 0
    printed = capsys.readouterr().out
    assert "adg, at once" in printed
    assert "new plans" in printed
    assert "before situation" in printed


def test_robots_that_never_go_and_robots_that_meet_are_noticed(few, monkeypatch, capsys):
    class Holding(TimedSession):
        def update(self, now, view):
            return attrs.evolve(super().update(now, view), released=view.reached * 0)

    class Held(Timed):
        def start(self, problem, plan):
            return Holding(problem, plan)

    only, names = {"prioritized": SOAK["planners"]()["prioritized"]}, SOAK["run"].__globals__
    monkeypatch.setitem(names, "components", lambda kind: {"held": Held, "careless": AllAtOnce})
    monkeypatch.setitem(names, "planners", lambda: only)
    monkeypatch.setitem(names, "LIMIT", 20.0)
    assert SOAK["run"](40, 3) > 0
    printed = capsys.readouterr().out
    assert "held" in printed
    assert "robots do not arrive" in printed
    assert "conflict: robot" in printed


@pytest.fixture
def quick(monkeypatch):
    names = TASKS["run"].__globals__
    some = {name: it for name, it in TASKS["assigners"]().items() if not name.startswith("ortools")}
    monkeypatch.setitem(names, "assigners", lambda: some)
    monkeypatch.setitem(names, "TICKS", 60)


def test_no_task_is_lost_in_the_first_executions(quick, capsys):
    assert TASKS["run"](500, 1) == 0
    assert "before situation" in capsys.readouterr().out


def test_a_task_that_is_done_twice_or_lost_is_noticed(quick, monkeypatch, capsys):
    rest, release = TaskBoard.rest, TaskBoard.release

    def twice(board, now, robot):
        job = board.current(robot)
        done = rest(board, now, robot)
        if done:
            board._note(now, job.task.index, "errand", robot, job.errand - 1)
        return done

    monkeypatch.setattr(TaskBoard, "rest", twice)
    assert TASKS["run"](100, 1) > 0
    assert "of 3 are done" in capsys.readouterr().out
    monkeypatch.setattr(TaskBoard, "rest", rest)

    def losing(board, now, task, vertices):
        release(board, now, task, vertices)
        if task.index == 3:
            del board.jobs[3]

    monkeypatch.setattr(TaskBoard, "release", losing)
    assert TASKS["run"](100, 1) > 0
    assert "tasks [3] are lost" in capsys.readouterr().out
