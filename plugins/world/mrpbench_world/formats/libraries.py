"""Imports libraries that only some formats need, or says how to install them."""

import importlib
from types import ModuleType

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.extras import pip


def library(name: str, extra: str) -> ModuleType:
    """Import a library.

    Raises:
        InputError: it is not installed.
    """
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise InputError(f"this format needs {name}: {error}", hint=f"{pip(extra)} installs it") from error
