"""What plugins import: the contracts of all kinds, the data that crosses them, and checks of results.

`__init__.pyi` lists the names by topic; the modules that define them may move. A name is imported when it is first used
(PEP 562), because some plugins need only a few.
"""

import ast
import importlib
import pathlib
import typing

_STUB = ast.parse(pathlib.Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
_MODULES = {
    name.name: str(node.module) for node in _STUB.body if isinstance(node, ast.ImportFrom) for name in node.names
}

__all__ = tuple(sorted(_MODULES))


def __getattr__(name: str) -> typing.Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = globals()[name] = getattr(importlib.import_module(_MODULES[name]), name)
    return value


def __dir__() -> list[str]:
    return sorted(globals().keys() | _MODULES.keys())
