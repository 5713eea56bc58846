"""A plugin on the command line: `NAME`, `KIND:NAME`, `./file.py:Class` or `package.module:Class`."""

from pathlib import Path

from mrpbench_core.api import KINDS
from mrpbench_core.api.component import Component
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import suggest
from mrpbench_core.plugins.installed import installed, load
from mrpbench_core.plugins.kinds import HOOKS, singular
from mrpbench_core.plugins.local import is_local, load_local
from mrpbench_core.plugins.provenance import kind_class


def resolve(name: str) -> tuple[type[Component], str]:
    """Return the class of the kind of a plugin, and the name that a configuration uses for the plugin.

    Raises:
        InputError: there is no such plugin, or several kinds have one of this name.
    """
    kind, _, rest = name.partition(":")
    kind = singular(kind)
    if kind in KINDS and rest:
        return KINDS[kind], rest
    offers = [provider for provider in installed() if provider.group != HOOKS]
    if kind in {provider.kind for provider in offers} and rest:  # a kind that some plugin defines
        return _own_kind(kind, rest), rest
    if is_local(name):
        cls = load_local(name, Path.cwd())
        if not isinstance(cls, type) or not issubclass(cls, Component) or not hasattr(cls, "group"):
            raise InputError(f"{name} is not a component", hint="derive it from a class of mrpbench_core.api")
        return kind_class(cls), name
    kinds = dict.fromkeys(provider.kind for provider in offers if provider.name == name.partition("@")[0])
    if len(kinds) > 1:
        raise InputError(
            f"several kinds have a plugin {name!r}", hint="write " + " or ".join(f"{each}:{name}" for each in kinds)
        )
    if not kinds:
        hint = suggest(name, {provider.name for provider in offers}, "`mrpbench plugins` lists what is installed:")
        raise InputError(f"no plugin is called {name!r}", hint=hint)
    (found,) = kinds
    return KINDS.get(found) or _own_kind(found, name), name


def _own_kind(kind: str, name: str) -> type[Component]:
    """Return the class of a kind that a plugin defines."""
    for provider in installed():
        if provider.kind == kind and provider.name == name.partition("@")[0]:
            cls = load(provider)
            if isinstance(cls, type) and issubclass(cls, Component):
                return kind_class(cls)
    raise InputError(f"no {kind} is called {name!r}", hint="`mrpbench plugins` lists what is installed")
