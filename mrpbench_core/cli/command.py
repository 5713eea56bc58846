"""Commands that installed distributions add to `mrpbench`.

A distribution adds a command with an entry point in the group `mrpbench.commands`: its name is that of the command, its
object is a `Command`. `mrpbench --help` imports this object, so the module that holds it imports nothing but this one,
and this one imports nothing that is not needed to list commands.
"""

import importlib
from collections.abc import Container, Iterable, Iterator
from importlib import metadata
from types import ModuleType
from typing import NamedTuple

from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.plugins.kinds import COMMANDS as GROUP


class Command(NamedTuple):
    """What `mrpbench --help` says about a command, and where its code is."""

    summary: str
    """What it does, e.g. `make a static site of published results`: lower case, without a period."""
    module: str
    """Module with `configure(parser)`, which declares the arguments, and `run(arguments) -> int`, which returns the
    exit code. It is imported when the command is named."""


def summaries(built_in: Container[str]) -> Iterator[tuple[str, str | InputError]]:
    """Yield name and summary of each command of other distributions, or the reason why it cannot be used.

    Args:
        built_in: names of the commands of the core, which no distribution replaces.
    """
    for name, offers in _offers().items():
        try:
            if name in built_in:
                raise InputError(f"{_said(offers[0])} is not used: mrpbench-core has a command of this name")
            yield name, _load(_only(offers)).summary
        except InputError as error:
            yield name, error


def find(name: str, built_in: Iterable[str]) -> tuple[str, ModuleType]:
    """Return the summary and the module of a command of another distribution.

    Args:
        name: the command.
        built_in: names of the commands of the core, for suggestions.

    Raises:
        InputError: no installed distribution has it, several have it, or it cannot be imported.
    """
    from mrpbench_core.files.suggestions import did_you_mean
    from mrpbench_core.plugins.installed import incompatibility
    from mrpbench_core.plugins.published import remedy

    known = _offers()
    if name not in known:
        hint = remedy(name, GROUP) or did_you_mean(name, [*built_in, *known], "see --help")
        raise InputError(f"no command is called {name!r}", hint=hint)
    entry = _only(known[name])
    if problem := incompatibility((entry.dist and entry.dist.requires) or ()):
        raise InputError(f"{_said(entry)} {problem}")
    command = _load(entry)
    try:
        return command.summary, importlib.import_module(command.module)
    except Exception as error:
        raise InputError(f"{_said(entry)} cannot be imported: {one_line(error)}") from error


def _offers() -> dict[str, list[metadata.EntryPoint]]:
    """Entry points by the name that they offer."""
    try:
        entries = list(metadata.entry_points(group=GROUP))
    except Exception:  # noqa: BLE001 - one distribution with damaged metadata must not cost the others
        from mrpbench_core.plugins.installed import entry_points

        entries = [entry for entry in entry_points() if entry.group == GROUP]
    offers: dict[str, list[metadata.EntryPoint]] = {}
    for entry in sorted(entries, key=lambda entry: (entry.name, _origin(entry))):
        offers.setdefault(entry.name, []).append(entry)
    return offers


def _only(offers: list[metadata.EntryPoint]) -> metadata.EntryPoint:
    if len(offers) > 1:
        origins = " and ".join(map(_origin, offers))
        raise InputError(f"command {offers[0].name!r} is offered by {origins}", hint="uninstall one of them")
    return offers[0]


def _load(entry: metadata.EntryPoint) -> Command:
    try:
        command = entry.load()
    except (Exception, SystemExit) as error:
        raise InputError(f"{_said(entry)} cannot be imported: {one_line(error)}") from error
    if not isinstance(command, Command):
        raise InputError(f"{_said(entry)}: {entry.value} is not a mrpbench_core.cli.command.Command")
    return command


def _said(entry: metadata.EntryPoint) -> str:
    return f"command {entry.name!r} of {_origin(entry)}"


def _origin(entry: metadata.EntryPoint) -> str:
    return f"{entry.dist.name} {entry.dist.version}" if entry.dist else "an unknown distribution"
