"""Throw-away distributions for tests of several packages."""

import importlib
import sys
import textwrap
from importlib import metadata

import pytest

from mrpbench_core.plugins import installed

collect_ignore = ["data"]


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Return a function that writes a throw-away distribution, as pip would leave it; while it lasts, only those exist.

    `install(name, {group: {name: value}}, code)`; `{module}` in a value is the distribution's one module.
    """
    site = tmp_path / "site"
    site.mkdir()
    monkeypatch.syspath_prepend(str(site))
    made = set()

    def entries():
        return [entry for name in made for entry in metadata.distribution(name).entry_points]

    def make(name, groups, code="", version="1.0", requires=(), files=None):
        module = name.replace("-", "_")
        (site / f"{module}.py").write_text(textwrap.dedent(code))
        folder = site / f"{module}-{version}.dist-info"
        folder.mkdir()
        lines = ["Metadata-Version: 2.1", f"Name: {name}", f"Version: {version}"]
        lines += [f"Requires-Dist: {requirement}" for requirement in requires]
        (folder / "METADATA").write_text("\n".join(lines) + "\n")
        text = ""
        for group, names in groups.items():
            text += f"[{group}]\n" + "".join(f"{key} = {value}\n" for key, value in names.items())
        (folder / "entry_points.txt").write_text(text.replace("{module}", module))
        for file, content in (files or {}).items():
            (folder / file).write_text(content)
        made.add(name)
        importlib.invalidate_caches()
        installed.refresh()
        return site / f"{module}.py"

    monkeypatch.setattr(installed, "entry_points", entries)
    installed.refresh()
    yield make
    for name in made:
        sys.modules.pop(name.replace("-", "_"), None)
    monkeypatch.undo()
    installed.refresh()
