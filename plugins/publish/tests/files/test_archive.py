"""Zip files of bundles: the same bytes for the same files, and no way out of their folder."""

import struct
import zipfile

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_publish.files.archive import pack, unpack

from mrpbench_core.files.errors import InputError

NAMES = st.lists(st.text("abcd", min_size=1, max_size=4), min_size=1, max_size=4, unique=True)


@given(names=NAMES, content=st.binary(max_size=200))
def test_what_is_packed_is_unpacked_and_does_not_depend_on_the_order(tmp_path_factory, names, content):
    folder = tmp_path_factory.mktemp("packed")
    files = {f"top/{name}.bin": content + name.encode() for name in names}
    pack(folder / "one.zip", files)
    pack(folder / "other.zip", dict(reversed(files.items())))
    assert (folder / "one.zip").read_bytes() == (folder / "other.zip").read_bytes()
    unpack(folder / "one.zip", folder)
    assert {name: (folder / name).read_bytes() for name in files} == files


def test_programs_are_executable_only_when_they_are_trusted(tmp_path):
    pack(tmp_path / "a.zip", {"top/run": b"#!/bin/sh\n"}, frozenset({"top/run"}))
    for trusted in (False, True):
        (tmp_path / str(trusted)).mkdir()
        unpack(tmp_path / "a.zip", tmp_path / str(trusted), programs=trusted)
        assert bool((tmp_path / str(trusted) / "top/run").stat().st_mode & 0o111) == trusted


def test_entries_that_overlap_are_refused(tmp_path):
    file = tmp_path / "bomb.zip"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("top/one", bytes(10_000))
        first = archive.filelist[0]
        for number in range(100):  # all begin at the same place
            twin = zipfile.ZipInfo(f"top/{number}")
            twin.CRC, twin.compress_size, twin.file_size = first.CRC, first.compress_size, first.file_size
            twin.header_offset = first.header_offset
            archive.filelist.append(twin)
    with pytest.raises(InputError, match="its entries overlap"):
        unpack(file, tmp_path)


def test_an_entry_before_the_beginning_of_the_file_is_refused(tmp_path):
    file = tmp_path / "a.zip"
    pack(file, {"top/one": b"1"})
    data = bytearray(file.read_bytes())
    (place,) = struct.unpack_from("<L", data, len(data) - 6)  # of the central directory
    struct.pack_into("<L", data, len(data) - 6, place + 50)  # readers take the difference for bytes before the zip file
    file.write_bytes(data)
    with pytest.raises(InputError, match="'top/one' is not inside the zip file"):
        unpack(file, tmp_path)


def test_an_entry_that_is_larger_than_it_says_is_refused(tmp_path):
    file = tmp_path / "a.zip"
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("top/one", bytes(100_000))
        archive.filelist[0].file_size = 10
    with pytest.raises(InputError):
        unpack(file, tmp_path)
    assert not (tmp_path / "top/one").exists() or (tmp_path / "top/one").stat().st_size <= 10


@pytest.mark.parametrize("method", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_methods_without_a_bound_are_refused(tmp_path, method):
    file = tmp_path / "a.zip"
    with zipfile.ZipFile(file, "w", method) as archive:
        archive.writestr("top/one", bytes(1000))
    with pytest.raises(InputError, match="is compressed by the method"):
        unpack(file, tmp_path)


def test_damage_is_an_error_of_one_line(tmp_path):
    pack(tmp_path / "a.zip", {"top/a": b"text " * 1000})
    content = bytearray((tmp_path / "a.zip").read_bytes())
    content[40:45] = b"XXXXX"
    (tmp_path / "a.zip").write_bytes(content)
    with pytest.raises(InputError, match=r"is damaged|is not a bundle"):
        unpack(tmp_path / "a.zip", tmp_path)
