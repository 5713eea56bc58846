"""Find components by name, and import only the chosen one."""

import functools
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Generic, TypeVar, cast

import attrs
from packaging.utils import canonicalize_name

from mrpbench_core.api.component import Component
from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.files.suggestions import closest
from mrpbench_core.plugins.contract import violation
from mrpbench_core.plugins.installed import Provider, load, providers
from mrpbench_core.plugins.kinds import kind_of
from mrpbench_core.plugins.local import is_local, load_local, source_of
from mrpbench_core.plugins.published import remedy

C = TypeVar("C", bound=Component)


@attrs.frozen
class Registry(Generic[C]):
    """The components of one kind: of a subclass of `Component` with its own `group`, also of a plugin's own kind."""

    base: type[C]

    @property
    def group(self) -> str:
        """Entry-point group."""
        return self.base.group

    @property
    def kind(self) -> str:
        """The word for the kind."""
        return kind_of(self.group)

    def __iter__(self) -> Iterator[Provider]:
        """Iterate over the installed components by name, without importing them."""
        offers = {(provider.name, provider.distribution): provider for provider in providers(self.group)}
        for group in getattr(self.base, "old_groups", ()):
            for provider in providers(group):
                offers.setdefault((provider.name, provider.distribution), provider)
        return iter(offers.values())

    def find(self, name: str) -> Provider:
        """Return the installed component called `name` (or `name@distribution`) without importing it.

        Raises:
            InputError: there is none, there are several, or it needs another version of the core.
        """
        wanted, _, owner = name.partition("@")
        named = [provider for provider in self if provider.name == wanted]
        if not named:
            raise self._unknown(name, wanted, [provider.name for provider in self])
        if owner:
            owners = [provider.distribution for provider in named]
            named = [entry for entry in named if canonicalize_name(entry.distribution) == canonicalize_name(owner)]
            if not named:
                raise self._unknown(name, owner, owners)
        if len(named) > 1:
            origins = " and ".join(provider.origin for provider in named)
            choice = " or ".join(f"{wanted}@{provider.distribution}" for provider in named)
            raise InputError(f"{self.kind} {wanted!r} is offered by {origins}", hint=f"write {choice}")
        if named[0].problem:
            raise InputError(f"{self.kind} {wanted!r} of {named[0].origin} {named[0].problem}")
        return named[0]

    def get(self, name: str, folder: Path | None = None, sources: Mapping[str, str] | None = None) -> type[C]:
        """Import the component called `name`; see `load_local` for `folder` and `sources`.

        Raises:
            InputError: see `find`; or the name is reserved, the import fails, or the class breaks the contract of its
                kind.
        """
        short = name.partition("@")[0].rpartition(":")[2]
        if short in self.base.reserved:
            raise InputError(f"a {self.kind} cannot be called {short!r}: records have a part of that name")
        if is_local(name):
            return self._accept(load_local(name, folder or Path.cwd(), sources), f"{self.kind} {name!r}")
        provider = self.find(name)
        return self._accept(load(provider), f"{self.kind} {provider.name!r} of {provider.origin}")

    def name_of(self, cls: type[Component], folder: Path | None = None) -> str:
        """Return the (first) name by which `get` finds `cls`; a local file is relative to `folder`."""
        if source := source_of(cls):
            written = Path(os.path.relpath(source.path, folder or Path.cwd())).as_posix()
            return f"{written}:{cls.__qualname__}"
        if provider := self.provider_of(cls):
            clash = sum(other.name == provider.name for other in self) > 1
            return f"{provider.name}@{provider.distribution}" if clash else provider.name
        return f"{cls.__module__}:{cls.__qualname__}"

    def provider_of(self, cls: type[Component]) -> Provider | None:
        """Return the provider of `cls`, or None for a local component."""
        return next((provider for provider in self if _offers(provider, cls)), None)

    def _accept(self, cls: Any, described: str) -> type[C]:
        try:
            fault = violation(cls, self.base)
            broken = f"{getattr(cls, '__name__', cls)!s:.80} {fault}" if fault else None
        except BaseException as error:  # noqa: BLE001 - a metaclass is code of the plugin
            broken = f"it cannot be examined: {one_line(error)}"
        if broken:
            raise InputError(f"{described}: {broken}")
        return cast("type[C]", cls)

    def _unknown(self, name: str, part: str, known: list[str]) -> InputError:
        if part not in known and (hint := remedy(part, self.base.group)):
            return InputError(f"no {self.kind} is called {name!r}", hint=hint)
        nearest = closest(part, known)
        hint = f"did you mean {name.replace(part, nearest)!r}? " if nearest else ""
        listed = f"`mrpbench plugins` lists what is installed: {', '.join(sorted(set(known))) or 'none'}"
        return InputError(f"no {self.kind} is called {name!r}", hint=hint + listed)


@functools.cache
def _offers(provider: Provider, cls: type[Component]) -> bool:
    if provider.value == f"{cls.__module__}:{cls.__qualname__}":
        return True
    if provider.value.partition(".")[0].partition(":")[0] != cls.__module__.partition(".")[0] or provider.problem:
        return False
    try:
        return load(provider) is cls  # offered under a shorter path than its definition
    except InputError:
        return False
