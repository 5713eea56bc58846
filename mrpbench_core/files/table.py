"""CSV tables with named columns, and compressed files."""

import csv
import gzip
import io
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import SIZE_LIMIT, read_bytes


def read_unpacked(file: Path) -> bytes:
    """Return the content of a file, decompressed if its name ends with `.gz`.

    Raises:
        InputError: it cannot be read, is not compressed by gzip, or is too large.
    """
    content = read_bytes(file)
    if not file.name.endswith(".gz"):
        return content
    try:
        with gzip.open(io.BytesIO(content)) as stream:
            content = stream.read(SIZE_LIMIT + 1)
    except (OSError, EOFError, zlib.error):
        raise InputError("is not compressed by gzip", file=file) from None
    if len(content) > SIZE_LIMIT:
        raise InputError(f"is larger than {SIZE_LIMIT // 2**20} MiB", file=file)
    return content


def read_rows(file: Path, columns: Sequence[str]) -> Iterator[tuple[int, dict[str, str]]]:
    """Yield the number of the line and the values of each row of a table, which may be compressed.

    Raises:
        InputError: it cannot be read, or lacks one of the `columns`; with the line.
    """
    try:
        text = read_unpacked(file).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError("is not UTF-8 text", file=file) from None
    table = csv.DictReader(io.StringIO(text, newline=""))
    try:
        if missing := set(columns) - set(table.fieldnames or ()):
            hint = f"the columns are {', '.join(columns)}"
            raise InputError(f"has no column {', '.join(sorted(missing))}", file=file, line=1, hint=hint)
        for row in table:
            yield table.line_num, row
    except csv.Error as error:
        raise InputError(f"is not CSV: {error}", file=file, line=max(1, table.line_num)) from None
