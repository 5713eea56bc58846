"""Checks that every hook plugin must pass: one that raises is disabled for the rest of its run."""

import logging
from collections.abc import Mapping
from typing import Any

import numpy as np

from mrpbench_core.model.execution.observation import Estimate, FleetObservation, Odometry
from mrpbench_core.model.execution.state import State
from mrpbench_core.plugins.hooks import LOG, Hooks
from mrpbench_core.testing.faults import require
from mrpbench_core.testing.fixtures.finished_run import context
from mrpbench_core.testing.fixtures.room import PERIOD

NAME = "checked"


class HookConformance:
    """Checks of hooks: `class TestMine(HookConformance)`; return the module or object with the hooks from `make`."""

    def make(self) -> object:
        """Return the plugin to check, as its entry point names it."""
        raise NotImplementedError("define make(self) and return the module or object with the hooks")

    def test_its_hooks_exist_and_take_arguments_that_they_have(self) -> None:
        _, said = self.registered()
        require(not said, "; ".join(said))

    def test_says_in_one_line_what_keeps_it_from_working(self) -> None:
        check = getattr(self.make(), "mrpbench_check", None)
        reason = None if check is None else check()
        line = reason is None or (isinstance(reason, str) and reason.strip() and "\n" not in reason)
        require(line, f"mrpbench_check returns {reason!r}: return one line, or None if nothing keeps it from working")

    def test_observes_a_study_without_raising(self) -> None:
        self.observe(runs=1)

    def test_observes_several_runs_in_one_process(self) -> None:
        self.observe(runs=2)

    def registered(self) -> tuple[Hooks, list[str]]:
        """The hooks of the plugin, and what was logged about them."""
        with _Log() as said:
            hooks = Hooks()
            hooks.register(self.make(), NAME)
        return hooks, said

    def observe(self, runs: int) -> None:
        """Call all hooks as a study does."""
        hooks, _ = self.registered()
        with _Log() as said:
            for hook, arguments in calls(runs):
                hooks.call(hook, **arguments)
        require(not said, "; ".join(said))


class _Log(logging.Handler):
    """Collects what is logged about hooks; the plugin's name says nothing here."""

    def __init__(self) -> None:
        super().__init__()
        self._said: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self._said.append(record.getMessage().removeprefix(f"hook plugin {NAME!r} "))

    def __enter__(self) -> list[str]:
        LOG.addHandler(self)
        self._before, LOG.propagate = LOG.propagate, False
        return self._said

    def __exit__(self, *_: object) -> None:
        LOG.removeHandler(self)
        LOG.propagate = self._before


def calls(runs: int) -> list[tuple[str, Mapping[str, Any]]]:
    """The hooks of a study of so many runs in order, with their arguments."""
    run = context()
    robots = len(run.fleet)
    pose, rest = np.array([route.waypoint[0] for route in run.routes]), np.zeros((robots, 2))
    pose[:, 2] = 0.0
    level = np.zeros(robots, np.int16)
    observation = FleetObservation(
        estimate=Estimate(pose=pose), odometry=Odometry(pose=np.zeros((robots, 3)), twist=rest), level=level, scans=()
    )
    state = State(pose=pose, twist=rest, level=level, contacts=np.empty((0, 2), np.int32))
    config = {"name": "checked", "seed": 0}
    record = {"run_id": run.run_id, "status": "succeeded", "config": config, "metrics": {}, "timing": {}}
    one: list[tuple[str, Mapping[str, Any]]] = [
        ("mrpbench_run_started", {"run_id": run.run_id, "config": config}),
        ("mrpbench_planned", {"problem": run.problem, "result": run.result}),
        ("mrpbench_executing", {"context": run}),
        *(
            (
                "mrpbench_stepped",
                {"now": step * PERIOD, "state": state, "observation": observation, "routes": run.routes},
            )
            for step in range(3)
        ),
        ("mrpbench_executed", {}),
        ("mrpbench_run_finished", {"record": record}),
    ]
    return [
        ("mrpbench_study_started", {"study": config, "runs": runs}),
        *(runs * one),
        ("mrpbench_study_finished", {"records": runs}),
    ]
