"""A full disk is told from other failures."""

import errno
import resource
import signal
import sqlite3
import subprocess
import sys

import pytest

from mrpbench_core.files.disk import is_full


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG])
def test_a_file_system_that_takes_no_more(number):
    assert is_full(OSError(number, "no room"))


@pytest.mark.parametrize("error", [OSError(errno.EACCES, "denied"), ValueError("no"), OSError("without a number")])
def test_other_failures_are_the_programs_own(error):
    assert not is_full(error)


def test_sqlite_says_it_in_its_own_words():
    with sqlite3.connect(":memory:") as base:
        base.execute("PRAGMA max_page_count = 2")
        with pytest.raises(sqlite3.OperationalError, match="full") as raised:
            base.executescript("CREATE TABLE t (x); INSERT INTO t VALUES (zeroblob(100000));")
        with pytest.raises(sqlite3.OperationalError) as mistake:
            base.execute("SELECT x FROM nowhere")
    base.close()
    assert is_full(raised.value)
    assert not is_full(mistake.value)


def test_sqlite_at_a_limit_of_file_sizes(tmp_path):
    limited = (
        "import sqlite3\nfrom mrpbench_core.files.disk import is_full\n"
        f"base = sqlite3.connect({str(tmp_path / 'base')!r})\n"
        "try:\n"
        "    base.executescript('CREATE TABLE t (x); INSERT INTO t VALUES (zeroblob(100000));')\n"
        "except sqlite3.Error as error:\n"
        "    print(is_full(error))\n"
    )

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    done = subprocess.run([sys.executable, "-c", limited], preexec_fn=limit, capture_output=True, text=True, timeout=30)
    assert done.stdout == "True\n"
