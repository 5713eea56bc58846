"""Sibling modules: the modules in the folder of a local plugin that it imports.

They are part of the plugin: its records contain them, and its hash depends on them. They are not imported through
`sys.path` and `sys.modules`, which may hold a module of the same name from another folder, or an older version.
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
    """Return the texts, by name, of the sibling modules that `text` imports, directly or through each other.

    Args:
        path: the plugin's file.
        text: its content.
        known: texts by file. If they contain the plugin itself they are complete, and the folder is not read.
    """
    texts: dict[str, str] = {}
    unread = [text]
    while unread:
        for name in _imported(unread.pop()):
            file = path.with_name(f"{name}.py")
            if name in texts or name in sys.stdlib_module_names or file == path:
                continue
            if file in known or (path not in known and file.is_file()):
                texts[name] = known[file] if file in known else read_text(file)
                unread.append(texts[name])
    return texts


def importing(names: Container[str], find: Callable[[str], ModuleType]) -> Callable[..., Any]:
    """Return an `__import__` that takes modules with these `names` from `find` and imports others as usual."""

    def take(name: str, *rest: Any, **named: Any) -> Any:
        return find(name) if name in names else builtins.__import__(name, *rest, **named)

    return take


def _imported(text: str) -> Iterator[str]:
    """Yield the names of modules that a text imports; none for invalid Python, which fails when it runs."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
