"""Load components that are not packaged: `./my_planner.py:MyPlanner` or `package.module:Class`."""

import builtins
import hashlib
import importlib
import linecache
import os
import sys
from collections.abc import Mapping
from itertools import chain
from pathlib import Path
from types import ModuleType
from typing import Any

import attrs

from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.files.text import read_text
from mrpbench_core.plugins.importing import is_interrupt, watched
from mrpbench_core.plugins.siblings import importing, sibling_imports

_PREFIX = "mrpbench_local_"
_refused = False


@attrs.frozen
class LocalSource:
    """The text of a local plugin, and those of the modules of its folder that it imports, directly or not."""

    path: Path
    text: str
    siblings: Mapping[str, str] = attrs.field(factory=dict)
    """Texts of these modules by name."""

    @property
    def sha256(self) -> str:
        """Hash of the texts."""
        return hashlib.sha256("\0".join([self.text, *chain(*sorted(self.siblings.items()))]).encode()).hexdigest()

    @property
    def files(self) -> dict[Path, str]:
        """All texts by file."""
        return {self.path: self.text} | {self.path.with_name(f"{name}.py"): it for name, it in self.siblings.items()}


def is_local(name: str) -> bool:
    """Tell whether a name refers to a local plugin."""
    return ":" in name


def refuse_local() -> None:
    """From now on, load no local plugins in this process: the configurations that it reads come from others."""
    global _refused
    _refused = True


def load_local(name: str, folder: Path, sources: Mapping[str, str] | None = None) -> Any:
    """Import the object that `name` refers to.

    Args:
        name: `file.py:Class`, the file relative to `folder`, or `package.module:Class`.
        folder: folder of the configuration.
        sources: texts by file, as written in `name`, which replace the content of the file.

    Raises:
        InputError: there is no such file, module or class, or importing it fails; or this process refuses them.
    """
    if _refused:
        raise InputError(f"{name!r} is code of the configuration's author, which is not executed here")
    where, _, attribute = name.partition(":")
    if not where or not attribute.isidentifier():
        raise InputError(f"{name!r} does not name a class", hint="write ./file.py:Class or package.module:Class")
    if where.endswith(".py"):
        path = Path(os.path.normpath(folder / where))
        known = {Path(os.path.normpath(folder / name)): text for name, text in (sources or {}).items()}
        text = known[path] if path in known else read_text(path)
        module = _import_source(LocalSource(path, text, sibling_imports(path, text, known)))
    else:
        module = _import_module(where)
    value = getattr(module, attribute, None)
    if value is None:
        raise InputError(f"{where} has no {attribute!r}")
    return value


def source_of(cls: type) -> LocalSource | None:
    """Return the source of a class from a local file, or None."""
    module = sys.modules.get(cls.__module__)
    return getattr(module, "__mrpbench_source__", None) if cls.__module__.startswith(_PREFIX) else None


def _import_module(name: str) -> ModuleType:
    try:
        with watched(name):
            return importlib.import_module(name)
    except InputError:
        raise
    except BaseException as error:
        if is_interrupt(error):
            raise
        raise InputError(f"{name} cannot be imported: {one_line(error)}") from error


def _import_source(source: LocalSource) -> ModuleType:
    # The name depends on path and content, so that an edited file is a new module.
    name = _PREFIX + hashlib.sha256(f"{source.path}\0{source.sha256}".encode()).hexdigest()[:24]
    if name in sys.modules:
        return sys.modules[name]
    module = ModuleType(name)
    module.__file__ = str(source.path)
    module.__mrpbench_source__ = source  # type: ignore[attr-defined]

    def find(sibling: str) -> ModuleType:
        path, text = source.path.with_name(f"{sibling}.py"), source.siblings[sibling]
        return _import_source(LocalSource(path, text, sibling_imports(path, text, source.files)))

    vars(module)["__builtins__"] = vars(builtins) | {"__import__": importing(source.siblings, find)}
    sys.modules[name] = module  # attrs and pickle find classes there
    linecache.cache[module.__file__] = (len(source.text), None, source.text.splitlines(keepends=True), module.__file__)
    try:
        with watched(module.__file__):
            exec(compile(source.text, module.__file__, "exec"), vars(module))  # noqa: S102 - running it is what was asked
    except InputError:  # of a sibling module, or of the import
        del sys.modules[name]
        raise
    except SyntaxError as error:
        del sys.modules[name]
        raise InputError(error.msg, file=source.path, line=error.lineno, column=error.offset) from error
    except BaseException as error:
        del sys.modules[name]
        if is_interrupt(error):
            raise
        raise InputError(f"{source.path} cannot be imported: {one_line(error)}") from error
    return module
