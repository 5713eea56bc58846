"""The files of a new distribution."""

from collections.abc import Mapping
from pathlib import Path
from string import Template

from mrpbench_core.files.errors import InputError
from mrpbench_scaffold.kinds import TEMPLATES
from mrpbench_scaffold.plugin import Form, Plugin

_LIBRARIES = {"attrs": "attrs>=24.2", "numpy": "numpy>=1.26"}
"""Libraries that templates may import, and what the distribution then requires."""
_SHARED = {".gitignore": "shared/gitignore.txt", "tests/test_{name}.py": "shared/test.py.txt"}
_PURE = _SHARED | {
    "pyproject.toml": "shared/pyproject.toml.txt",
    "README.md": "shared/README.md.txt",
    "{package}/__init__.py": "shared/init.py.txt",
    "{package}/py.typed": "shared/py.typed.txt",
}
_FILES: Mapping[Form, Mapping[str, str]] = {
    "python": _PURE | {"{package}/{name}.py": "kinds/{kind}.py.txt"},
    "external": _PURE
    | {
        "README.md": "external/README.md.txt",
        "{package}/{name}.py": "external/planner.py.txt",
        "tests/test_{name}.py": "external/test.py.txt",
        "tests/stand_in.py": "external/stand_in.py.txt",
    },
    "native": _SHARED
    | {
        "pyproject.toml": "native/pyproject.toml.txt",
        "README.md": "native/README.md.txt",
        "CMakeLists.txt": "native/CMakeLists.txt.txt",
        "src/{name}.hpp": "native/planner.hpp.txt",
        "src/{name}.cpp": "native/planner.cpp.txt",
        "src/module.cpp": "native/module.cpp.txt",
        "python/{package}/__init__.py": "shared/init.py.txt",
        "python/{package}/py.typed": "shared/py.typed.txt",
        "python/{package}/{name}.py": "native/planner.py.txt",
        "python/{package}/_solver.pyi": "native/solver.pyi.txt",
    },
}
"""The files of each form, and their templates."""


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
            if text.startswith("#!"):
                path.chmod(0o755)
    except FileExistsError:
        raise InputError("exists already and is not overwritten", file=folder) from None
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=folder) from None


def contents(plugin: Plugin) -> dict[str, str]:
    """Return the text of each file, by its path in the folder."""
    names = {"package": plugin.package, "name": plugin.name, "kind": plugin.kind}
    templates = {file.format_map(names): path.format_map(names) for file, path in _FILES[plugin.form].items()}
    placeholders = plugin.placeholders | {"requires": _requires(plugin)}
    return {file: _filled(_text(path), placeholders) for file, path in templates.items()}


def _requires(plugin: Plugin) -> str:
    """The requirements as lines of a TOML list, in alphabetical order."""
    imported = [requirement for name, requirement in _LIBRARIES.items() if f"import {name}" in plugin.module]
    ours = ["mrpbench-core", "mrpbench-standard"] if plugin.facts.standard else ["mrpbench-core"]
    versions = _filled(">=$version,<$next_version", plugin.placeholders)
    lines = sorted([*imported, *(name + versions for name in ours)])
    return "\n".join(f'    "{line}",' for line in lines)


def _filled(text: str, placeholders: dict[str, str]) -> str:
    return Template(text).substitute(placeholders)


def _text(path: str) -> str:
    return TEMPLATES.joinpath(path).read_text(encoding="utf-8")
