"""Text files that are none."""

import os
import threading

import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_bytes, read_text
from mrpbench_core.files.yaml import load


def test_a_named_pipe_into_which_nobody_writes_is_empty_and_one_with_a_writer_is_read_to_its_end(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    with pytest.raises(InputError, match="is empty"):
        load(tmp_path / "pipe.yaml")
    reading, writing = os.pipe()

    def write():
        for part in (b"a", b"b"):
            os.write(writing, part)
        os.close(writing)

    threading.Timer(0.05, write).start()
    assert read_text(f"/dev/fd/{reading}") == "ab"
    os.close(reading)


def test_a_folder_and_a_missing_file_are_said(tmp_path):
    with pytest.raises(InputError, match="is a folder, not a file"):
        read_bytes(tmp_path)
    with pytest.raises(InputError, match="no such file"):
        read_bytes(tmp_path / "none")
