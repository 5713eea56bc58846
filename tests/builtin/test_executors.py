"""Executors on this machine."""

import threading

import pytest

from mrpbench_core.builtin.executors import Processes, Serial
from mrpbench_core.files.errors import InputError


def test_processes_does_as_many_calls_at_once_as_it_has_workers():
    meeting = threading.Barrier(3)
    with Processes().open(3) as executor:
        calls = [executor.submit(meeting.wait, 10) for _ in range(3)]
        assert sorted(call.result() for call in calls) == [0, 1, 2]


def test_serial_has_one_worker_and_says_so():
    with Serial().open(1) as executor:
        assert executor.submit(threading.get_ident).result() != threading.get_ident()
    with pytest.raises(InputError, match="one worker, not 2"):
        Serial().open(2)
