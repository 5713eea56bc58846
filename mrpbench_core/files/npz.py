"""Reads and writes arrays in zips: `.npz` files and recordings with many small `.npy` files, maybe those of others."""

import math
import zipfile
from functools import lru_cache
from io import BytesIO
from typing import Any

import numpy as np
from isal import isal_zlib
from numpy.lib import format as npy
from numpy.typing import NDArray

_HEADERS = {1: (2, npy.read_array_header_1_0), 2: (4, npy.read_array_header_2_0)}
"""By major version: bytes of the header's length, and what reads both."""


def read_entry(source: zipfile.ZipFile, entry: zipfile.ZipInfo) -> bytes:
    """The content of a file in a zip.

    Raises:
        ValueError: it is compressed by a method that decompresses without a bound.
    """
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError(f"{entry.filename} is compressed by the method {entry.compress_type}")
    with source.open(entry) as stream:
        return stream.read(entry.file_size)


def write_entry(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    """Add a file without a date, so that equal contents make equal zips, byte by byte."""
    archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED, compresslevel=1)


def write_chunk(archive: zipfile.ZipFile, name: str, array: NDArray[Any]) -> None:
    """Add an array as a `.npy` file in a fourth of the time: by ISA-L, whose bytes may differ from those of zlib."""
    header, rows = BytesIO(), np.ascontiguousarray(array)
    npy.write_array_header_1_0(header, npy.header_data_from_array_1_0(rows))
    entry = zipfile.ZipInfo(name)
    entry.compress_type, entry.file_size = zipfile.ZIP_DEFLATED, header.tell() + rows.nbytes
    with archive.open(entry, "w") as stream:
        stream._compressor = isal_zlib.compressobj(2, isal_zlib.DEFLATED, -15)  # type: ignore[attr-defined]
        stream.write(header.getvalue())
        stream.write(rows.view(np.uint8).data if rows.size else b"")


def array_bytes(array: NDArray[Any]) -> bytes:
    """The content of a `.npy` file."""
    buffer = BytesIO()
    np.save(buffer, array, allow_pickle=False)
    return buffer.getvalue()


def read_array(content: bytes) -> NDArray[Any]:
    """The array of a `.npy` file; equal headers, which most chunks of a channel have, are parsed once.

    Raises:
        ValueError: it is damaged, or its entries are objects.
    """
    version = npy.read_magic(BytesIO(content[: npy.MAGIC_LEN]))[0]
    if version not in _HEADERS:
        raise ValueError(f"an array of version {version}")
    width = _HEADERS[version][0]
    begin = npy.MAGIC_LEN + width
    begin += int.from_bytes(content[npy.MAGIC_LEN : begin], "little")
    shape, by_columns, dtype = _header(content[:begin])
    if dtype.hasobject:
        raise ValueError("an array of objects")
    if not dtype.itemsize or not math.prod(shape):
        return np.zeros(shape, dtype, "F" if by_columns else "C")
    array = np.frombuffer(content, dtype, math.prod(shape), begin).copy()
    return array.reshape(shape[::-1]).T if by_columns else array.reshape(shape)


@lru_cache(maxsize=1024)
def _header(content: bytes) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Shape, whether columns are stored one after another, and type."""
    stream = BytesIO(content)
    shape, by_columns, dtype = _HEADERS[npy.read_magic(stream)[0]][1](stream)
    if min(shape, default=0) < 0:
        raise ValueError(f"an array of the shape {shape}")
    return shape, by_columns, dtype
