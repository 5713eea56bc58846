"""Versions of distributions; those of editable installations name the commit of the checkout."""

import functools
import json
import subprocess
from importlib import metadata
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit
from urllib.request import url2pathname

from packaging.version import InvalidVersion, Version


@functools.cache
def direct_url(name: str) -> Any:
    """Return where a distribution was installed from (PEP 610), or None if it came from an index."""
    text = metadata.distribution(name).read_text("direct_url.json")
    try:
        return json.loads(text) if text else None
    except ValueError:
        return None


def version_of(name: str) -> str:
    """Return the version of an installed distribution.

    The metadata of an editable installation keep the version of the day of the installation, while its modules are
    those of the checkout now. Its version is therefore followed by the commit, and by `dirty` if files have changed, as
    in `0.2.1.dev0+g1a2b3c4d5e6f.dirty`. Compiled modules are as old as the metadata.
    """
    owner = metadata.distribution(name)
    url = direct_url(name)
    editable = isinstance(url, dict) and (url.get("dir_info") or {}).get("editable")
    if not editable or "Root-Is-Purelib: true" not in (owner.read_text("WHEEL") or ""):
        return owner.version
    commit = _commit(Path(url2pathname(urlsplit(str(url.get("url"))).path)))
    try:
        installed = Version(owner.version)
    except InvalidVersion:
        return owner.version
    if not commit:
        return owner.version
    return f"{f'{installed.base_version}.dev0' if installed.is_devrelease else installed.public}+{commit}"


@functools.cache
def _commit(folder: Path) -> str:
    """Return the commit that is checked out as a local version (PEP 440); empty without git."""
    command = ["git", "-C", str(folder), "describe", "--always", "--exclude=*", "--abbrev=12", "--dirty"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=10, check=True)
    except (OSError, subprocess.SubprocessError):
        return ""
    return "g" + done.stdout.strip().replace("-", ".")
