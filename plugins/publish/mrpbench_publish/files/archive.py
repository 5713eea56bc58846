"""The zip file of a bundle: equal content gives equal bytes, and a hostile file is refused before it takes space."""

import stat
import unicodedata
import zipfile
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from shutil import copyfileobj

from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.files.output import create_file

RATIO = 200
"""Largest unpacked size of a bundle, as a multiple of its file."""
UNBOUNDED = 256 * 2**20
"""Unpacked bytes that every bundle may take."""
LONGEST = 240
"""Characters of the name of a file in a bundle."""
_BLOCK = 2**20
_DATE = (1980, 1, 1, 0, 0, 0)
"""The earliest time that a zip file can hold: times of files are not a part of a bundle."""


def pack(out: Path, files: Mapping[str, Path | bytes], programs: frozenset[str] = frozenset()) -> None:
    """Write a zip file with entries in the order of their names, without times.

    Args:
        out: written under a temporary name first.
        files: content or place of each file by its name in the zip file.
        programs: names of the files that are executable.

    Raises:
        OSError: a file cannot be read, or the zip file cannot be written.
    """
    partial = out.with_name(f".{out.name}.partial")
    try:
        with create_file(partial) as stream, zipfile.ZipFile(stream, "w") as archive:
            for name in sorted(files):
                entry = zipfile.ZipInfo(name, _DATE)
                entry.create_system = 3  # Unix, whose modes follow
                entry.external_attr = (stat.S_IFREG | (0o755 if name in programs else 0o644)) << 16
                entry.compress_type = zipfile.ZIP_STORED if name.endswith(".zip") else zipfile.ZIP_DEFLATED
                content = files[name]
                if isinstance(content, bytes):
                    archive.writestr(entry, content)
                    continue
                entry.file_size = content.stat().st_size
                with content.open("rb") as source, archive.open(entry, "w") as target:
                    copyfileobj(source, target, _BLOCK)
        partial.replace(out)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise


def unpack(file: Path, folder: Path, *, programs: bool = False) -> None:
    """Unpack a bundle of a stranger into an empty folder; every name and size is checked before.

    Args:
        file: the bundle.
        folder: receives regular files only.
        programs: make the files executable that the bundle marks so.

    Raises:
        InputError: it is not a zip file, it is damaged, or an entry of it could leave the folder, is a link, is there
            twice, or takes more space than a bundle may.
    """
    try:
        with zipfile.ZipFile(file) as archive:
            entries = archive.infolist()
            if fault := _fault(entries, file.stat().st_size):
                raise InputError(f"is refused: {fault}", file=file)
            for entry in entries:
                _unpack_entry(archive, entry, folder, programs)
    except InputError:
        raise
    except FileNotFoundError:
        raise InputError("no such file", file=file) from None
    except IsADirectoryError:
        raise InputError("is a folder; a bundle is a zip file", file=file) from None
    except (zipfile.BadZipFile, EOFError, ValueError, NotImplementedError, RuntimeError) as error:
        raise InputError(f"is not a bundle: {one_line(error)}", file=file) from None
    except Exception as error:
        if isinstance(error, OSError):
            raise
        raise InputError(f"is damaged: {one_line(error)}", file=file) from None  # zlib has its own error


def _fault(entries: list[zipfile.ZipInfo], size: int) -> str | None:
    """Why a zip file of `size` bytes with these entries is not unpacked."""
    for entry in entries:
        fault = _entry_fault(entry)
        if fault is None and not 0 <= entry.header_offset < size:
            fault = "is not inside the zip file"
        if fault:
            return f"{entry.filename!r:.80} {fault}"
    names: set[str] = set()
    for entry in entries:
        name = unicodedata.normalize("NFC", entry.filename).casefold()
        if name in names:
            return f"{entry.filename!r:.80} is there twice"
        names.add(name)
    for name in names:
        if any(str(above) in names for above in PurePosixPath(name).parents):
            return f"{name!r:.80} is below a file"
    total = sum(entry.file_size for entry in entries)
    if total > max(RATIO * size, UNBOUNDED):
        return f"it would take {total / 2**30:.1f} GiB; a bundle takes at most {RATIO} times its size"
    if sum(entry.compress_size for entry in entries) > size:
        return "its entries overlap"  # D. Fifield, "A better zip bomb", WOOT 2019
    return None


def _entry_fault(entry: zipfile.ZipInfo) -> str | None:
    name, mode = entry.filename, entry.external_attr >> 16
    parts = name.split("/")
    if name.startswith("/") or {"", ".", ".."} & set(parts):
        return "is a folder" if parts[-1] == "" else "does not stay in its folder"
    if "\\" in name or ":" in name or not name.isprintable() or len(name) > LONGEST:
        return "has a name that not every system can store"
    if stat.S_IFMT(mode) not in (0, stat.S_IFREG):
        return "is a link" if stat.S_ISLNK(mode) else "is not a file"
    if entry.flag_bits & 1:
        return "is encrypted"
    if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):  # others decompress without a bound
        return f"is compressed by the method {entry.compress_type}"
    return None


def _unpack_entry(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, folder: Path, programs: bool) -> None:
    target = folder / entry.filename
    target.parent.mkdir(parents=True, exist_ok=True)
    left = entry.file_size
    with archive.open(entry) as source, create_file(target) as stream:
        while block := source.read(min(_BLOCK, left + 1)):
            left -= len(block)
            if left < 0:
                raise InputError(f"is refused: {entry.filename!r:.80} is larger than it says", file=archive.filename)
            stream.write(block)
    if programs and entry.external_attr >> 16 & 0o100:
        target.chmod(0o755)
