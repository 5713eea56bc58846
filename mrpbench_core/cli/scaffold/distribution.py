"""The files of a new distribution."""

from pathlib import Path
from string import Template

from mrpbench_core.cli.scaffold.kinds import TEMPLATES
from mrpbench_core.cli.scaffold.plugin import Plugin
from mrpbench_core.files.errors import InputError

_LIBRARIES = {"attrs": "attrs>=24.2", "numpy": "numpy>=1.26"}
"""Libraries that templates may import, and what the distribution then requires."""
_SHARED = {
    "pyproject.toml": "shared/pyproject.toml.txt",
    "README.md": "shared/README.md.txt",
    ".gitignore": "shared/gitignore.txt",
    "{package}/__init__.py": "shared/init.py.txt",
}


def write(plugin: Plugin, folder: Path) -> None:
    """Write the distribution.

    Raises:
        InputError: the folder exists already, or cannot be written.
    """
    texts = contents(plugin)
    try:
        folder.mkdir(parents=True)
        for file, text in texts.items():
            path = folder / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
    except FileExistsError:
        raise InputError("exists already and is not overwritten", file=folder) from None
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=folder) from None


def contents(plugin: Plugin) -> dict[str, str]:
    """Return the text of each file, by its path in the folder."""
    placeholders = plugin.placeholders | {"requires": _requires(plugin)}
    files = {file.format(package=plugin.package, name=plugin.name): path for file, path in _SHARED.items()}
    texts = {file: _filled(_text(path), placeholders) for file, path in files.items()}
    texts[f"{plugin.package}/{plugin.name}.py"] = _filled(plugin.module, placeholders)
    own = TEMPLATES.joinpath("tests", f"{plugin.kind}.py.txt")
    test = own if own.is_file() else TEMPLATES.joinpath("shared/test.py.txt")
    texts[f"tests/test_{plugin.name}.py"] = _filled(test.read_text(encoding="utf-8"), placeholders)
    texts[f"{plugin.package}/py.typed"] = ""
    return texts


def _requires(plugin: Plugin) -> str:
    """The requirements as lines of a TOML list, in alphabetical order."""
    imported = [requirement for name, requirement in _LIBRARIES.items() if f"import {name}" in plugin.module]
    lines = sorted({*imported, "mrpbench-core>=$version,<$next_version", *plugin.facts.requires})
    return "\n".join(f'    "{_filled(line, plugin.placeholders)}",' for line in lines)


def _filled(text: str, placeholders: dict[str, str]) -> str:
    return Template(text).substitute(placeholders)


def _text(path: str) -> str:
    return TEMPLATES.joinpath(path).read_text(encoding="utf-8")
