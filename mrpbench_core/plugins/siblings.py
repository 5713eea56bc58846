"""Modules that lie beside a local plugin: which it imports, and how it gets them.

They are part of the plugin: they travel with it and count for its hash. So they are not left to `sys.path` and
`sys.modules`, where another folder's module of the same name, or an older text of this one, may be.
"""

import ast
import builtins
import sys
from collections.abc import Callable, Container, Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

from mrpbench_core.files.text import read_text


def sibling_imports(path: Path, text: str, known: Mapping[Path, str]) -> dict[str, str]:
    """Texts by name of the modules in the folder of `path` that its `text`, and theirs, import anywhere.

    Args:
        path: the plugin's file.
        text: what it says.
        known: texts by file. If they name the plugin itself, they name all: the folder is not looked at.
    """
    found: dict[str, str] = {}
    unread = [text]
    while unread:
        for name in _imported(unread.pop()):
            file = path.with_name(f"{name}.py")
            if name in found or name in sys.stdlib_module_names or file == path:
                continue
            if file in known or (path not in known and file.is_file()):
                found[name] = known[file] if file in known else read_text(file)
                unread.append(found[name])
    return found


def importing(names: Container[str], find: Callable[[str], ModuleType]) -> Callable[..., Any]:
    """An `__import__` that takes modules of these `names` from `find`, and all others from where Python does."""

    def take(name: str, *rest: Any, **named: Any) -> Any:
        return find(name) if name in names else builtins.__import__(name, *rest, **named)

    return take


def _imported(text: str) -> Iterator[str]:
    """Names of the modules that a text imports; of one that is no Python, none: running it will say so."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
