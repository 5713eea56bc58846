"""A run owns every process that it starts, and nothing that it changes reaches another run."""

import os
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from mrpbench_core import run
from mrpbench_core.store.invocation import write_document

PLANNERS = '''
import ctypes
import errno
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import attrs
import numpy as np

from mrpbench_core.api import Planner, option
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus


@attrs.frozen(kw_only=True)
class Rogue(Planner):
    does: str = option("nothing", help="what to do")
    marks: str = option("", help="folder for marks")

    def plan(self, problem, budget):
        getattr(self, self.does)()
        return PlanResult(status=PlanStatus.UNSOLVABLE)

    def nothing(self):
        assert np.hypot(3, 4) == 5
        assert sys.path
        assert threading.active_count() == 1
        with open(os.path.join(tempfile.gettempdir(), "file"), "xb") as file:
            file.write(bytes(4096))

    def escape(self):
        """Leave a process in a session of its own, whose parent has ended."""
        self.fork_twice(lambda: time.sleep(1000))

    def fork_twice(self, work):
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                Path(self.marks, str(os.getpid())).touch()
                work()
            os._exit(0)
        os.wait()
        while not list(Path(self.marks).iterdir()):
            time.sleep(0.01)

    def hide_memory(self):
        self.fork_twice(lambda: (bytearray(b"x") * 700_000_000, time.sleep(1000)))
        time.sleep(1000)

    def hang_with_escaped(self):
        self.escape()
        time.sleep(1000)

    def spoil(self):
        """Change everything that the next run of one process would meet."""
        np.hypot = lambda a, b: 0
        sys.path.clear()
        threading.Thread(target=time.sleep, args=(1000,)).start()
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
        os.chdir("/")
        os.environ.clear()

    def stop(self):
        """Stop the process that tells the supervisor when this one has ended."""
        os.kill(os.getppid(), signal.SIGSTOP)

    def limit_files(self):
        """Let nothing be written, which looks like a full disk."""
        resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
        raise OSError(errno.EFBIG, "too large")

    def close_all(self):
        os.closerange(0, 300)

    def replace_folder(self):
        """Put a link to another folder in the place of the folder for temporary files."""
        os.rmdir(tempfile.gettempdir())
        os.symlink(self.marks, tempfile.gettempdir())
        Path(self.marks, "kept").touch()

    def raise_without_text(self):
        class Wordless(Exception):
            def __str__(self):
                raise SystemExit(3)

        raise Wordless

    def shout(self):
        """Write to every descriptor, as text and as bytes."""
        for descriptor in range(3, 256):
            for content in (b'{"record": {}}\\n', bytes(64)):
                try:
                    os.write(descriptor, content)
                except OSError:
                    break
        time.sleep(1000)
'''
AT_IMPORT = {
    "exit": ("import os; os._exit(7)", "ended with exit code 7"),
    "segfault": ("import ctypes; ctypes.string_at(0)", "was ended by SIGSEGV"),
    "folder": ("import os; os.chdir('/')", "changes the working directory when it is imported"),
    "thread": (
        "import threading, time; threading.Thread(target=time.sleep, args=(9,), daemon=True).start()",
        "starts a thread when it is imported",
    ),
    "raise": ("raise ValueError('no')", "cannot be imported: ValueError: no"),
}


pytestmark = pytest.mark.usefixtures("kept_workers")


@pytest.fixture
def rogue(study, tmp_path):
    """Return a function: the records of runs that each do one thing, by what they do."""
    (tmp_path / "rogue.py").write_text(PLANNERS)
    study["planner"] = {"plugin": "./rogue.py:Rogue", "marks": str(tmp_path / "marks")}
    study["limits"] = {"planning": 4.0, "wall": 30.0, "memory": "500 MiB"}

    def outcomes(*does, **options):
        results = run(study | {"matrix": {"planner.does": list(does)}}, out="out", **options)
        return {record["config"]["planner"]["does"]: record for record in results}

    return outcomes


def escaped():
    """The marked process, if it still runs."""
    (mark,) = Path("marks").iterdir()
    try:
        process = psutil.Process(int(mark.name))
    except psutil.NoSuchProcess:
        return None
    return None if process.status() == psutil.STATUS_ZOMBIE else process


@pytest.mark.parametrize("does", ["escape", "hang_with_escaped"])
def test_a_process_in_another_session_ends_with_its_run(rogue, does):
    record = rogue(does)[does]
    assert record["status"] == {"escape": "plan_unsolvable", "hang_with_escaped": "plan_timeout"}[does]
    assert escaped() is None


def test_memory_of_a_process_that_left_its_parent_counts(rogue):
    record = rogue("hide_memory")["hide_memory"]
    assert record["status"] == "out_of_memory"
    assert escaped() is None


def test_what_a_run_changes_does_not_reach_the_next_one(rogue):
    records = rogue("spoil", "nothing")
    assert records["spoil"]["status"] == "crashed", "it let no file be written, and a run writes a recording"
    assert records["nothing"]["status"] == "plan_unsolvable"


def test_a_plugin_that_writes_to_every_descriptor_crashes_its_own_run_only(rogue):
    records = rogue("shout", "nothing", workers=1)
    assert records["nothing"]["status"] == "plan_unsolvable"
    assert records["shout"]["status"] == "crashed"
    assert "a plugin wrote to the connection of the engine" in records["shout"]["error"]["message"]


def test_a_plugin_that_stops_the_process_that_forks_costs_its_own_run_only(rogue):
    records = rogue("stop", "nothing")
    assert {record["status"] for record in records.values()} == {"plan_unsolvable"}


def test_a_plugin_that_leaves_its_process_without_descriptors_folder_or_words_costs_its_own_run_only(rogue):
    records = rogue("close_all", "replace_folder", "raise_without_text", "nothing")
    assert {does: record["status"] for does, record in records.items()} == {
        "close_all": "crashed",
        "replace_folder": "plan_unsolvable",
        "raise_without_text": "crashed",
        "nothing": "plan_unsolvable",
    }
    assert records["close_all"]["error"]["stage"] == "planning"
    assert "Wordless" in records["raise_without_text"]["error"]["message"]
    assert Path("marks", "kept").exists()


def test_a_plugin_that_limits_the_size_of_files_has_a_record_and_is_not_done_again(rogue):
    record = rogue("limit_files")["limit_files"]
    assert record["status"] == "crashed"
    assert "too large" in record["error"]["message"]


@pytest.mark.parametrize("name", AT_IMPORT)
def test_what_a_plugin_does_when_it_is_imported_is_its_error_by_name(study, tmp_path, name):
    code, message = AT_IMPORT[name]
    (tmp_path / "bad.py").write_text(code)
    study["planner"] = "./bad.py:Planner"
    folder = os.getcwd()  # noqa: PTH109
    with pytest.raises(Exception, match=message) as caught:
        run(study, out="out")
    assert "bad.py" in str(caught.value)
    assert os.getcwd() == folder  # noqa: PTH109


def test_a_killed_invoker_takes_processes_in_other_sessions_with_it(rogue, study, tmp_path):
    study["planner"]["does"] = "hang_with_escaped"
    study["limits"] = {}
    write_document(tmp_path / "rogue.yaml", study)
    invoker = subprocess.Popen([sys.executable, "-m", "mrpbench_core.cli.main", "run", "rogue.yaml", "--out", "out"])
    deadline = time.monotonic() + 60
    while not list(Path("marks").iterdir()):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    invoker.kill()
    invoker.wait()
    while escaped() is not None:
        assert time.monotonic() < deadline
        time.sleep(0.05)
