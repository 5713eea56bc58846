"""Runs of the core before processes are forked."""

import threading

from mrpbench_core.engine.processes import warm_up
from mrpbench_core.model.runs.status import RunStatus


def test_they_go_through_all_stages_of_planning_and_leave_nothing_behind(monkeypatch, tmp_path):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    records = []
    monkeypatch.setattr(warm_up, "execute", lambda *given: records.append(execute(*given)) or records[-1])
    threads = threading.active_count()
    warm_up.warm_up()
    assert [record.status for record in records] == [RunStatus.SUCCEEDED] * warm_up.TIMES
    assert records[0].plan["cost"] == 1
    assert threading.active_count() == threads  # a process with threads must not be forked
    assert not list(tmp_path.iterdir())


execute = warm_up.execute
