"""One invocation at a time."""

import errno
import os
import signal
import subprocess
import sys

import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.lock import locked

HOLD = "import sys, time; from pathlib import Path; from mrpbench_core.store.lock import locked\n"
HOLD += "with locked(Path(sys.argv[1])): print('held', flush=True); time.sleep(60)"


def test_the_error_of_a_second_holder_names_the_first(tmp_path):
    with subprocess.Popen([sys.executable, "-c", HOLD, tmp_path], stdout=subprocess.PIPE) as holder:
        assert holder.stdout.readline() == b"held\n"
        told = f"another invocation is working in this folder .process {holder.pid} on"
        with pytest.raises(InputError, match=told), locked(tmp_path):
            pass
        holder.send_signal(signal.SIGKILL)
    with locked(tmp_path):
        pass


def test_the_lock_is_free_again_after_an_error(tmp_path):
    with pytest.raises(ZeroDivisionError), locked(tmp_path):
        raise ZeroDivisionError
    with locked(tmp_path):
        pass


@pytest.mark.parametrize("thing", ["link", "folder", "fifo"])
def test_what_is_in_the_place_of_the_lock_is_named_and_left_alone(tmp_path, thing):
    lock, precious = tmp_path / ".lock", tmp_path / "precious.txt"
    precious.write_text("precious")
    {"link": lambda: lock.symlink_to(precious), "folder": lock.mkdir, "fifo": lambda: os.mkfifo(lock)}[thing]()
    with pytest.raises(InputError, match=r"\.lock: .*cannot be locked"), locked(tmp_path):
        pass
    assert precious.read_text() == "precious"


def test_a_read_only_disk_is_one_line(tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(InputError, match=r"\.lock: cannot be locked: Read-only file system"), locked(tmp_path):
        pass
