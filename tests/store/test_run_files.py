"""The SHA-256 of the files of a run."""

import inspect
import os
import subprocess
import sys

import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.store.folder import ResultsFolder
from mrpbench_core.store.run_files import check_recording, seal


@pytest.fixture
def paths(tmp_path):
    folder = ResultsFolder(tmp_path)
    folder.create()
    found = folder.run("ab", 2)
    found.recording.write_bytes(b"recording")
    (found.exports / "bag").mkdir(parents=True)
    (found.exports / "bag" / "a b.mcap").write_bytes(b"bag")
    return found


def test_sha256sum_checks_every_file_of_a_run(paths, tmp_path):
    lines = seal(paths)
    assert [line.split("  ")[1] for line in lines] == ["recordings/ab-2.zip", "exports/ab-2/bag/a b.mcap"]
    checked = subprocess.run(
        ["sha256sum", "--check", "--strict"], input="\n".join(lines), text=True, cwd=tmp_path, capture_output=True
    )
    assert (checked.returncode, checked.stderr) == (0, "")


def test_a_recording_that_is_not_kept_and_a_run_without_files_have_no_sum(paths, tmp_path):
    assert [line.split("  ")[1] for line in seal(paths, recording=False)] == ["exports/ab-2/bag/a b.mcap"]
    assert seal(ResultsFolder(tmp_path).run("other")) == []


def test_links_and_fifos_that_a_format_left_are_passed_over(paths, tmp_path):
    (paths.exports / "link").symlink_to("/etc/passwd")
    os.mkfifo(paths.exports / "fifo")
    assert len(seal(paths)) == 2


@pytest.mark.parametrize("name", [b"a\nb", b"a\x1b[31m", b"\xff", b"folder\n/file"])
def test_files_whose_names_no_line_can_hold_have_no_sum(paths, name):
    file = os.path.join(os.fsencode(paths.exports), name)  # noqa: PTH118 - a name that is not text
    os.makedirs(os.path.dirname(file), exist_ok=True)  # noqa: PTH103, PTH120
    with open(file, "wb"):  # noqa: PTH123
        pass
    assert len(seal(paths)) == 2


def test_nested_folders_are_read_without_recursion(paths):
    deep, levels = paths.exports, 200
    for _ in range(levels):
        deep /= "d"
        deep.mkdir()
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + levels // 2)
    try:
        found = seal(paths)
    finally:
        sys.setrecursionlimit(limit)
    assert len(found) == 2


def test_another_recording_than_the_one_of_the_record_is_named(paths):
    record = {"provenance": {"files": seal(paths)}}
    check_recording(record, paths.recording)
    paths.recording.write_bytes(b"forged!!!")
    with pytest.raises(InputError, match=r"ab-2\.zip: differs from the recording of the run"):
        check_recording(record, paths.recording)
    check_recording({"provenance": {}}, paths.recording)  # records of older versions name no files
