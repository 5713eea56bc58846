"""Commands that installed distributions add to `mrpbench`.

A distribution adds a command with an entry point in the group `mrpbench.commands`: its name is that of the command, its
object is a `Command`. `mrpbench --help` imports this object, so the module that holds it imports nothing but this one.
"""

import importlib
from collections.abc import Container, Iterable, Iterator
from itertools import groupby
from types import ModuleType
from typing import NamedTuple

from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.plugins.installed import Provider, load, providers
from mrpbench_core.plugins.kinds import COMMANDS as GROUP
from mrpbench_core.plugins.published import remedy


class Command(NamedTuple):
    """What `mrpbench --help` says about a command, and where its code is."""

    summary: str
    """What it does, e.g. `make a static site of published results`: lower case, without a period."""
    module: str
    """Module with `configure(parser)`, which declares the arguments, and `run(arguments) -> int`, which returns the
    exit code. It is imported when the command is named."""


def summaries(own: Container[str]) -> Iterator[tuple[str, str | InputError]]:
    """Yield name and summary of each command of other distributions, or the reason why it cannot be used.

    Args:
        own: names of the commands of the core, which no distribution replaces.
    """
    for name, offers in _offers():
        try:
            if name in own:
                origins = " and ".join(provider.origin for provider in offers)
                raise InputError(f"command {name!r} of {origins} is not used: mrpbench-core has a command of this name")
            yield name, _load(offers).summary
        except InputError as error:
            yield name, error


def find(name: str, own: Iterable[str]) -> tuple[str, ModuleType]:
    """Return the summary and the module of a command of another distribution.

    Args:
        name: the command.
        own: names of the commands of the core, for suggestions.

    Raises:
        InputError: no installed distribution has it, several have it, or it cannot be imported.
    """
    known = dict(_offers())
    if name not in known:
        hint = remedy(name, GROUP) or did_you_mean(name, [*own, *known], "see --help")
        raise InputError(f"no command is called {name!r}", hint=hint)
    command = _load(known[name])
    try:
        return command.summary, importlib.import_module(command.module)
    except Exception as error:
        raise InputError(f"{_said(known[name][0])} cannot be imported: {one_line(error)}") from error


def _offers() -> Iterator[tuple[str, list[Provider]]]:
    """Yield each name with the distributions' entry points that offer it."""
    for name, offers in groupby(providers(GROUP), key=lambda provider: provider.name):
        yield name, list(offers)


def _load(offers: list[Provider]) -> Command:
    """Import the `Command` that one distribution offers."""
    first = offers[0]
    if len(offers) > 1:
        origins = " and ".join(provider.origin for provider in offers)
        raise InputError(f"command {first.name!r} is offered by {origins}", hint="uninstall one of them")
    if first.problem:
        raise InputError(f"{_said(first)} {first.problem}")
    command = load(first)
    if not isinstance(command, Command):
        raise InputError(f"{_said(first)}: {first.value} is not a mrpbench_core.cli.command.Command")
    return command


def _said(provider: Provider) -> str:
    return f"{provider.kind} {provider.name!r} of {provider.origin}"
