"""Call lifecycle hooks. A hook that raises is logged once and disabled, so that no result depends on it."""

import copy
import logging
import os
from collections.abc import Callable, Mapping
from typing import Any

import attrs
import pluggy
from packaging.utils import canonicalize_name

from mrpbench_core.api import hooks as specifications
from mrpbench_core.files.errors import LONGEST, InputError, one_line
from mrpbench_core.files.suggestions import closest
from mrpbench_core.plugins.installed import Provider, load, providers
from mrpbench_core.plugins.kinds import HOOKS

LOG = logging.getLogger("mrpbench.hooks")
DISABLE = "MRPBENCH_DISABLE_PLUGINS"
"""Environment variable: names of hook plugins or distributions that are not loaded, separated by commas."""


_SPECIFIED = tuple(name for name in vars(specifications) if name.startswith("mrpbench_"))


@attrs.frozen
class _Implementation:
    plugin: str
    function: Callable[..., Any]
    arguments: tuple[str, ...]


class Hooks:
    """The hook plugins of one process."""

    def __init__(self) -> None:
        self._known: dict[str, list[_Implementation]] = {}
        self._off: set[str] = set()
        self.refused: list[str] = []
        """Plugins that could not be registered."""

    @property
    def disabled(self) -> tuple[str, ...]:
        """Plugins that raised since the last `enable`, and plugins that were refused."""
        return (*self.refused, *sorted(self._off))

    def enable(self) -> None:
        """Enable all implementations again for a new run."""
        self._off.clear()

    def register(self, plugin: object, name: str) -> None:
        """Add the implementations of a plugin; a plugin with unknown hooks or wrong arguments is refused."""
        manager = pluggy.PluginManager("mrpbench")
        manager.add_hookspecs(specifications)
        try:
            manager.register(plugin, name)
            callers = manager.get_hookcallers(plugin) or []
        except BaseException as error:  # noqa: BLE001 - a plugin's attributes may raise anything
            self._refuse(name, one_line(error))
            return
        for caller in callers:
            if not caller.has_spec():
                near = closest(caller.name, _SPECIFIED)
                self._refuse(name, f"there is no hook {caller.name}" + (f"; did you mean {near}?" if near else ""))
                return
            if any(found.hookwrapper or found.wrapper for found in caller.get_hookimpls()):
                self._refuse(name, f"{caller.name} is a wrapper; hooks only observe")
                return
        if not callers:
            self._refuse(name, "it implements no hook; mark functions with mrpbench_core.api.hookimpl")
        for caller in callers:
            for found in caller.get_hookimpls():
                implementation = _Implementation(name, found.function, tuple(found.argnames))
                self._known.setdefault(caller.name, []).append(implementation)

    def load(self, provider: Provider) -> None:
        """Import and register an installed plugin."""
        if provider.problem:
            self._refuse(provider.name, f"{provider.origin} {provider.problem}")
            return
        try:
            self.register(load(provider), provider.name)
        except InputError as error:
            self._refuse(provider.name, str(error))

    def has(self, hook: str) -> bool:
        """Tell whether any plugin implements `hook`."""
        return hook in self._known

    def call(self, hook: str, **arguments: Any) -> None:
        """Call every implementation of `hook`. Mappings are copied, so that no plugin can change a record."""
        for found in self._known.get(hook, ()):
            if found.plugin in self._off:
                continue
            try:
                found.function(**{name: _own(arguments[name]) for name in found.arguments})
            except BaseException as error:  # noqa: BLE001 - calling a plugin runs its code
                self._off.add(found.plugin)
                LOG.warning("hook plugin %r is disabled for this run: %s: %s", found.plugin, hook, one_line(error))

    def check(self) -> None:
        """Log what each plugin says that keeps it from working, before any run."""
        for found in self._known.get("mrpbench_check", ()):
            try:
                problem = found.function()
                said = " ".join(str(problem)[:LONGEST].split()) if problem else ""
            except BaseException as error:  # noqa: BLE001 - calling a plugin runs its code
                said = f"mrpbench_check: {one_line(error)}"
            if said:
                LOG.warning("hook plugin %r: %s", found.plugin, said)

    def _refuse(self, name: str, reason: str) -> None:
        self.refused.append(name)
        LOG.warning("hook plugin %r is not used: %s", name, reason)


def enabled_hooks() -> list[Provider]:
    """The installed hook plugins except those that `MRPBENCH_DISABLE_PLUGINS` names."""
    names = {canonicalize_name(name.strip()) for name in os.environ.get(DISABLE, "").split(",")}
    return [
        provider
        for provider in providers(HOOKS)
        if names.isdisjoint({canonicalize_name(provider.name), canonicalize_name(provider.distribution)})
    ]


def load_hooks() -> Hooks:
    """Load the enabled hook plugins."""
    hooks = Hooks()
    for provider in enabled_hooks():
        hooks.load(provider)
    return hooks


def _own(value: Any) -> Any:
    return copy.deepcopy(value) if isinstance(value, Mapping) else value
