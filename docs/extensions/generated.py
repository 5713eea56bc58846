"""Directives that write parts of the reference from the code.

`{components} KIND` lists every installed component of mrpbench of a kind with its options, `{settings}` the keys of a
configuration, `{command-line}` the commands, and `{words-of MODULE}` is the docstring of a module.
"""

import argparse
import importlib
import inspect
from collections.abc import Iterator
from typing import Any

import attrs
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from mrpbench_core.api.component import Component
from mrpbench_core.cli.command import find
from mrpbench_core.cli.main import COMMANDS
from mrpbench_core.cli.output.plugin import facts_of
from mrpbench_core.config.settings import FleetEntry, RunConfig
from mrpbench_core.plugins.installed import installed, providers
from mrpbench_core.plugins.kinds import COMMANDS as GROUP

OURS = "mrpbench-"
"""How the names of our distributions begin: a site lists no plugin that its builder happens to have installed."""


class Written(SphinxDirective):
    """A directive whose content is Markdown that code writes.

    The content has no headings, or begins with one: what stands before a heading would come after its section.
    """

    optional_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Parse what `lines` gives."""
        return self.parse_text_to_nodes("\n".join(self.lines()), allow_section_headings=True)

    def lines(self) -> Iterator[str]:
        """The lines of Markdown."""
        raise NotImplementedError


class Components(Written):
    """All components of one kind."""

    required_arguments = 1
    optional_arguments = 0

    def lines(self) -> Iterator[str]:
        """A section for each component."""
        kind = self.arguments[0]
        found = [it for it in installed() if it.kind == kind and it.distribution.startswith(OURS)]
        if not found:
            raise self.error(f"no {kind} is installed")
        for provider in found:
            facts = facts_of(f"{kind}:{provider.name}")
            yield from ("", f"({kind}-{provider.name})=", f"## {provider.name}", facts["description"], "")
            yield f"Distribution: `{facts['distribution']}`."
            for key in ("supports", "promises", "requires", "hooks"):
                if facts.get(key):
                    yield f"{key.capitalize()}: {', '.join(f'`{word}`' for word in facts[key])}."
            if facts.get("columns"):
                yield from table(facts["columns"], ("name", "unit", "better", "description", "source"), "column")
            if facts.get("options"):
                yield from table(facts["options"], ("name", "default", "unit", "type", "help"), "option")
            elif "options" in facts:
                yield "It has no options."


class Settings(Written):
    """The keys of a configuration, or of an entry of `fleet`."""

    def lines(self) -> Iterator[str]:
        """A table of all keys, and one for each group of keys."""
        if self.arguments:
            yield from settings_of(FleetEntry, "")
        else:
            yield "## Keys"
            yield from settings_of(RunConfig, "")


def settings_of(cls: type[Any], prefix: str) -> Iterator[str]:
    """Tables of the keys of a class and of the classes that its keys hold."""
    rows, groups = [], []
    for field in attrs.fields(attrs.resolve_types(cls)):
        default = field.metadata.get("written_default", field.default)
        group = type(default) if attrs.has(type(default)) and not isinstance(default, Component) else None
        if group is not None:
            groups.append((field.alias, group))
        rows.append(
            {
                "name": prefix + field.alias,
                "default": "" if group else written(default),
                "unit": field.metadata.get("unit") or "",
                "help": field.metadata.get("help", ""),
            }
        )
        if field.alias == "fleet":
            rows[-1]["default"] = "turtlebot3_burger"
    yield from table(rows, ("name", "default", "unit", "help"), "key")
    for name, group in groups:
        yield from ("", f"## {name}", inspect.getdoc(group) or "")
        yield from settings_of(group, f"{prefix}{name}.")


def written(default: Any) -> str:
    """A default as a configuration writes it."""
    if default is attrs.NOTHING:
        return "required"
    if isinstance(default, tuple):
        return f"[{', '.join(map(str, default))}]"
    return "none" if default is None else str(default).lower() if isinstance(default, bool) else str(default)


class CommandLine(Written):
    """The commands and their arguments."""

    def lines(self) -> Iterator[str]:
        """A section for each command."""
        added = [it.name for it in providers(GROUP) if it.distribution.startswith(OURS)]
        for command in (*COMMANDS, *added):
            if command in added:
                summary, module = find(command, COMMANDS)
            else:
                summary = COMMANDS[command]
                module = importlib.import_module(f"mrpbench_core.cli.{command.replace('-', '_')}")
            parser = argparse.ArgumentParser(prog=f"mrpbench {command}")
            module.configure(parser)
            usage = " ".join(parser.format_usage().removeprefix("usage: ").split())
            yield from ("", f"## {command}", f"{summary[0].upper()}{summary[1:]}.", "", f"`{usage}`", "")
            rows = [
                {
                    "name": ", ".join(action.option_strings) or str(action.metavar or action.dest),
                    "default": shown(action.default),
                    "help": (action.help or "") % vars(action),
                }
                for action in parser._actions  # argparse has no public list of them
                if action.dest != "help" and action.help != argparse.SUPPRESS
            ]
            if rows:
                yield from table(rows, ("name", "default", "help"), "argument")


def shown(default: Any) -> str:
    """The default of an argument, if it says something."""
    return "" if default in (None, False, [], argparse.SUPPRESS) else str(default)


class WordsOf(Written):
    """The docstring of a module, which is Markdown."""

    required_arguments = 1
    optional_arguments = 0

    def lines(self) -> Iterator[str]:
        """The docstring."""
        yield inspect.getdoc(importlib.import_module(self.arguments[0])) or ""


CODE = ("name", "default", "type")
"""Columns that are printed as code."""


def table(rows: list[dict[str, Any]], keys: tuple[str, ...], first: str) -> Iterator[str]:
    """A table in Markdown; `first` is the title of the first column."""
    heads = [first, *keys[1:]]
    yield ""
    yield f"| {' | '.join(heads)} |"
    yield "|" + "---|" * len(heads)
    for row in rows:
        cells = (cell(row[key], code=key in CODE) for key in keys)
        yield f"| {' | '.join(cells)} |"
    yield ""


def cell(value: Any, *, code: bool) -> str:
    """A value in a table."""
    text = " ".join(str(value).split()).replace("|", "\\|")
    return f"`{text}`" if code and text else text


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directives."""
    for name, directive in (
        ("components", Components),
        ("settings", Settings),
        ("command-line", CommandLine),
        ("words-of", WordsOf),
    ):
        app.add_directive(name, directive)
    return {"parallel_read_safe": True}
