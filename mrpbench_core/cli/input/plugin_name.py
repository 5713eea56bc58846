"""A plugin on the command line: `NAME`, `KIND:NAME`, `./file.py:Class` or `package.module:Class`."""

from pathlib import Path

from mrpbench_core.api import KINDS, ReadableFormat, WritableFormat
from mrpbench_core.api.component import Component
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean, suggest
from mrpbench_core.plugins.installed import Provider, installed, load, providers
from mrpbench_core.plugins.kinds import HOOKS, RENAMED, asked_kind, kind_of, singular
from mrpbench_core.plugins.local import is_local, load_local
from mrpbench_core.plugins.provenance import kind_class
from mrpbench_core.plugins.published import remedy

OLD_KINDS: dict[str, type[Component]] = {"exporter": WritableFormat, "importer": ReadableFormat}
"""What kinds of earlier releases mean, which are read until the next one."""


def resolve(name: str) -> tuple[type[Component], str]:
    """Return the class of the kind of a plugin, and the name that a configuration uses for the plugin.

    Raises:
        InputError: there is no such plugin, or several kinds have one of this name.
    """
    kind, _, rest = name.partition(":")
    kind = singular(kind)
    if kind in RENAMED and rest:
        asked_kind(kind)
        return OLD_KINDS[kind], rest
    if kind in KINDS and rest:
        return KINDS[kind], rest
    offers = [provider for provider in installed() if provider.group != HOOKS]
    if kind in {provider.kind for provider in offers} and rest:  # a kind that some plugin defines
        return _foreign_kind(kind, rest), rest
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
        known = {provider.name for provider in offers}
        hint = remedy(name.partition("@")[0]) or did_you_mean(name, known, "`mrpbench plugins` lists what is installed")
        raise InputError(f"no plugin is called {name!r}", hint=hint)
    (matching_kind,) = kinds
    return KINDS.get(matching_kind) or _foreign_kind(matching_kind, name), name


def hook_named(name: str) -> Provider | None:
    """Return the hook that `hook:NAME` or, where no component has this name, `NAME` means.

    Raises:
        InputError: `hook:NAME` names no hook.
    """
    kind, _, rest = name.partition(":")
    asked = bool(rest) and singular(kind) == kind_of(HOOKS)
    wanted, _, owner = (rest if asked else name).partition("@")
    hooks = [provider for provider in providers(HOOKS) if owner in ("", provider.distribution)]
    hook = next((provider for provider in hooks if provider.name == wanted), None)
    if asked and hook is None:
        known = sorted({provider.name for provider in hooks})
        hint = suggest(rest, known, "`mrpbench plugins hook` lists what is installed:")
        raise InputError(f"no hook is called {rest!r}", hint=hint)
    others = any(provider.name == wanted for provider in installed() if provider.group != HOOKS)
    return hook if asked or not others else None


def _foreign_kind(kind: str, name: str) -> type[Component]:
    """Return the class of a kind that a plugin defines."""
    for provider in installed():
        if provider.kind == kind and provider.name == name.partition("@")[0]:
            if provider.problem:
                raise InputError(f"{kind} {provider.name!r} of {provider.origin} {provider.problem}")
            cls = load(provider)
            if isinstance(cls, type) and issubclass(cls, Component):
                return kind_class(cls)
    raise InputError(f"no {kind} is called {name!r}", hint="`mrpbench plugins` lists what is installed")
