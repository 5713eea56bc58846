"""Watches the import of plugins, whose modules may do anything."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from mrpbench_core.files.errors import InputError

Listener = Callable[[str | None], object]


def _ignore(plugin: str | None) -> None: ...


_listener: Listener = _ignore
_faults: dict[str, str] = {}
_going: list[str] = []


def tell_imports(listener: Listener) -> None:
    """From now on, call `listener` with the plugin whose import begins or continues, and with None when none does."""
    global _listener
    _listener = listener


def is_interrupt(error: BaseException) -> bool:
    """Tell whether an exception is Ctrl-C of the user: processes that import plugins have another handler for it."""
    return isinstance(error, KeyboardInterrupt) and signal.getsignal(signal.SIGINT) is signal.default_int_handler


@contextmanager
def attributed_to(plugin: str) -> Iterator[None]:
    """Tell the listener that a plugin is imported, or called while the process can still say nothing else of it."""
    _going.append(plugin)
    _listener(plugin)
    try:
        yield
    finally:
        _going.pop()
        _listener(_going[-1] if _going else None)


@contextmanager
def watched(plugin: str) -> Iterator[None]:
    """Watch the import of a plugin, which must not change what other plugins of the process rely on.

    Raises:
        InputError: the import changes the working directory or leaves a thread running; also at later imports.
    """
    folder, threads = os.getcwd(), threading.active_count()  # noqa: PTH109 - a string for chdir
    with attributed_to(plugin):
        yield
    if os.getcwd() != folder:  # noqa: PTH109
        os.chdir(folder)
        _faults[plugin] = "changes the working directory when it is imported"
    if threading.active_count() > threads:
        _faults[plugin] = "starts a thread when it is imported"
    if plugin in _faults:
        raise InputError(f"{plugin} {_faults[plugin]}", hint="do that in a session, not at module level")
