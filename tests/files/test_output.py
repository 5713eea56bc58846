"""Whole files, and what may be in their place."""

import os

import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.output import replace_file, write_page_file


def test_a_page_replaces_a_page_and_leaves_nothing_else(tmp_path):
    file = tmp_path / "report.html"
    write_page_file(file, "old")
    write_page_file(file, "new")
    assert file.read_text() == "new"
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize("thing", ["link", "folder", "fifo"])
def test_what_is_in_the_place_of_a_page_is_named_and_left_alone(tmp_path, thing):
    file, precious = tmp_path / "report.html", tmp_path / "precious.txt"
    precious.write_text("precious")
    {"link": lambda: file.symlink_to(precious), "folder": file.mkdir, "fifo": lambda: os.mkfifo(file)}[thing]()
    with pytest.raises(InputError, match=r"report\.html: is not a file, so no page is written there"):
        write_page_file(file, "<p>")
    assert precious.read_text() == "precious"
    assert sorted(tmp_path.iterdir()) == [precious, file]


def test_a_link_in_the_place_of_the_temporary_file_is_not_followed(tmp_path):
    precious = tmp_path / "precious.txt"
    precious.write_text("precious")
    (tmp_path / f".study.yaml.{os.getpid()}.partial").symlink_to(precious)
    replace_file(tmp_path / "study.yaml", b"new")
    assert precious.read_text() == "precious"
    assert (tmp_path / "study.yaml").read_bytes() == b"new"


def test_a_file_that_cannot_be_finished_leaves_the_old_one(tmp_path, monkeypatch):
    file = tmp_path / "study.yaml"
    file.write_text("old")
    monkeypatch.setattr(os, "fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(OSError, match="No space left"):
        replace_file(file, b"new", sync=True)
    assert file.read_text() == "old"
    assert list(tmp_path.iterdir()) == [file]
