"""The tag files of a bag: J. Kunze et al., "The BagIt File Packaging Format (V1.0)", RFC 8493, 2018."""

import re
from collections.abc import Iterator, Mapping
from hashlib import sha256
from pathlib import Path
from urllib.parse import quote

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.store.run_files import digest
from mrpbench_publish.files.layout import DECLARATION, INFO, MANIFEST, PAYLOAD, TAG_MANIFEST

DECLARED = "BagIt-Version: 1.0\nTag-File-Character-Encoding: UTF-8\n"
_LINE = re.compile(r"([0-9a-f]{64})  (\S.*)")
_TAGS = (DECLARATION, INFO, MANIFEST)
"""The tag files that the tag manifest lists."""


def tag_files(payload: Mapping[str, Path | bytes], info: Mapping[str, str]) -> dict[str, bytes]:
    """Return the tag files of a bag.

    Args:
        payload: content or place of each file by its name, which begins with `data/`.
        info: labels and values of `bag-info.txt` in addition to the size.
    """
    size = sum(len(part) if isinstance(part, bytes) else part.stat().st_size for part in payload.values())
    lines = {**info, "Payload-Oxum": f"{size}.{len(payload)}"}
    sums = {name: _sha256(part) for name, part in payload.items()}
    tags = {
        DECLARATION: DECLARED.encode(),
        INFO: "".join(f"{label}: {' '.join(value.split())}\n" for label, value in lines.items()).encode(),
        MANIFEST: _manifest(sums),
    }
    return tags | {TAG_MANIFEST: _manifest({name: _sha256(text) for name, text in tags.items()})}


def read_info(folder: Path) -> dict[str, str]:
    """Return the labels and values of `bag-info.txt`; the last value of a label counts.

    Raises:
        InputError: it cannot be read.
    """
    pairs = (line.partition(":") for line in read_text(folder / INFO).splitlines())
    return {label.strip(): value.strip() for label, colon, value in pairs if colon}


def bag_faults(folder: Path) -> Iterator[str]:
    """Yield what is wrong with an unpacked bag: each file must be listed with its hash, and no other may be there."""
    there = {str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()}
    payload = {name for name in there if name.startswith(PAYLOAD)}
    try:
        if read_text(folder / DECLARATION) != DECLARED:
            yield f"{DECLARATION} does not declare BagIt 1.0 in UTF-8"
        yield from _listed(folder, MANIFEST, payload)
        yield from _listed(folder, TAG_MANIFEST, set(_TAGS))
        oxum = f"{sum((folder / name).stat().st_size for name in payload)}.{len(payload)}"
        if (said := read_info(folder).get("Payload-Oxum")) != oxum:
            yield f"{INFO} says {said} bytes.files, there are {oxum}"
    except InputError as error:
        yield f"{error.file and error.file.name}: {error.message}"
    for name in sorted(there - payload - {*_TAGS, TAG_MANIFEST}):
        yield f"{name} does not belong to a bundle"


def _listed(folder: Path, manifest: str, expected: set[str]) -> Iterator[str]:
    sums: dict[str, str] = {}
    for number, line in enumerate(read_text(folder / manifest).splitlines(), 1):
        match = _LINE.fullmatch(line)
        if match is None or _decoded(match[2]) in sums:
            yield f"{manifest}:{number} is not a line of a manifest, or repeats one"
        else:
            sums[_decoded(match[2])] = match[1]
    for name in sorted(expected - sums.keys()):
        yield f"{name} is not listed in {manifest}"
    for name in sorted(sums.keys() - expected):
        yield f"{name} is listed in {manifest} and is not there"
    for name in sorted(expected & sums.keys()):
        if not (folder / name).is_file() or digest(folder / name) != sums[name]:
            yield f"{name} is not the file whose SHA-256 {manifest} has"


def _sha256(part: Path | bytes) -> str:
    return sha256(part).hexdigest() if isinstance(part, bytes) else digest(part)


def _manifest(sums: Mapping[str, str]) -> bytes:
    return "".join(f"{sums[name]}  {_encoded(name)}\n" for name in sorted(sums)).encode()


def _encoded(name: str) -> str:
    """Escape what RFC 8493 escapes in names: line ends and the percent sign."""
    return re.sub(r"[%\r\n]", lambda match: quote(match[0], safe=""), name)


def _decoded(name: str) -> str:
    return name.replace("%0D", "\r").replace("%0A", "\n").replace("%25", "%")
