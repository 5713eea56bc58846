"""The names of a new plugin."""

import keyword
import re
from string import Template
from typing import Literal

import attrs
from packaging.version import Version

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import suggest
from mrpbench_core.plugins.installed import installed
from mrpbench_core.plugins.kinds import asked_kind, group_of
from mrpbench_core.version import __version__
from mrpbench_scaffold.kinds import TEMPLATES, Kind, facts_of, kinds

NAME = re.compile(r"[a-z][a-z0-9]*([_-][a-z0-9]+)*")
Form = Literal["python", "native", "external"]
"""A component in Python; a planner in C++; a planner that runs a program."""


@attrs.frozen
class Plugin:
    """The names of a new plugin; all follow from its kind and name."""

    kind: str
    name: str
    form: Form = "python"

    @property
    def group(self) -> str:
        """Entry-point group."""
        return group_of(self.kind)

    @property
    def package(self) -> str:
        """Name of the package."""
        return f"mrpbench_{self.group.rpartition('.')[2]}_{self.name}"

    @property
    def distribution(self) -> str:
        """Name of the distribution."""
        return self.package.replace("_", "-")

    @property
    def class_name(self) -> str:
        """Name of the component's class."""
        return "".join(word.capitalize() for word in self.name.split("_"))

    @property
    def facts(self) -> Kind:
        """What is particular to its kind."""
        return facts_of(self.kind, self.form)

    @property
    def options(self) -> str:
        """Required options as words of `mrpbench check`, each after a blank."""
        return "".join(f" {key}={value}" for key, value in self.facts.options.items())

    @property
    def module(self) -> str:
        """The text of its module, with placeholders."""
        folder, name = ("kinds", self.kind) if self.form == "python" else (self.form, "planner")
        return TEMPLATES.joinpath(folder, f"{name}.py.txt").read_text(encoding="utf-8")

    @property
    def placeholders(self) -> dict[str, str]:
        """Values of the placeholders in the templates."""
        core = Version(__version__)
        options = self.facts.options
        arguments = ", ".join(f"{key}={value}" for key, value in options.items())
        exported = self.facts.instance or self.class_name
        names = {
            "kind": self.kind,
            "words": self.kind.replace("_", " "),
            "Kind": self.kind.replace("_", " ").capitalize(),
            "group": self.group,
            "name": self.name,
            "package": self.package,
            "distribution": self.distribution,
            "Class": self.class_name,
            "exported": exported,
            "made": self.facts.instance or f"{self.class_name}({arguments})",
            "made_type": "object" if self.facts.instance else self.class_name,
            "Suite": "".join(word.capitalize() for word in self.kind.split("_")) + "Conformance",
            "suites": self.facts.suites,
            "version": f"{core.major}.{core.minor}{'.dev0' if core.is_prerelease else ''}",
            "next_version": f"{core.major}.{core.minor + 1}",
            "example": self.options,
            "yaml": "".join(f", {key}: {value}" for key, value in options.items()),
        }
        return names | {"usage": Template(self.facts.usage).substitute(names)}


def named(kind: str, name: str, form: Form = "python") -> Plugin:
    """Return the names of the plugin that the user asks for.

    Raises:
        InputError: there is no template for the kind, or the name is invalid or taken.
    """
    kind = asked_kind(kind)
    if kind not in kinds():
        raise InputError(
            f"there is no template for a {kind!r}", hint=suggest(kind, set(kinds()), f"there are {', '.join(kinds())}")
        )
    if form != "python" and kind != "planner":
        raise InputError(f"--{form} is for planners, not for a {kind.replace('_', ' ')}")
    plugin = Plugin(kind, name.replace("-", "_"), form)
    if not NAME.fullmatch(name):
        raise InputError(
            f"{name!r} is not a name", hint="use lower-case letters, digits and _, beginning with a letter"
        )
    if keyword.iskeyword(plugin.name):
        raise InputError(f"{name!r} is a keyword of Python", hint="choose another name")
    if plugin.class_name in re.findall(r"\b[A-Z]\w*", plugin.module):
        raise InputError(f"the template already uses the name {plugin.class_name}", hint="choose another name")
    for provider in installed():
        if provider.group == plugin.group and provider.name == plugin.name:
            raise InputError(f"{kind} {plugin.name!r} is installed already, by {provider.origin}")
    return plugin
