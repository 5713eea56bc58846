"""Call lifecycle hooks. A hook that raises is logged once and disabled, so that no result depends on it."""

import logging
import os
from collections.abc import Callable
from typing import Any

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


class Hooks:
    """The hook plugins of one process, in a `pluggy.PluginManager`."""

    def __init__(self) -> None:
        self._manager = pluggy.PluginManager("mrpbench")
        self._manager.add_hookspecs(specifications)
        self._functions: dict[str, list[tuple[str, Callable[..., Any], tuple[str, ...]]]] = {}
        """By hook, the name of each plugin, its function and the names of the arguments that this takes."""
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
        try:
            self._manager.register(plugin, name)
            fault = self._fault(plugin)
        except BaseException as error:  # noqa: BLE001 - a plugin's attributes may raise anything
            fault = one_line(error)
        if fault is None:
            for caller in self._manager.get_hookcallers(plugin) or []:
                self._functions.setdefault(caller.name, []).extend(
                    (name, implementation.function, tuple(implementation.argnames))
                    for implementation in caller.get_hookimpls()
                    if implementation.plugin is plugin
                )
        else:
            if self._manager.has_plugin(name):
                self._manager.unregister(name=name)
            self._refuse(name, fault)

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
        return hook in self._functions

    def call(self, hook: str, **arguments: Any) -> None:
        """Call every implementation of `hook`, except of plugins that raised in this run."""
        for name, function, names in self._functions.get(hook, ()):
            if name in self._off:
                continue
            try:
                function(*[arguments[it] for it in names])
            except BaseException as error:  # noqa: BLE001 - calling a plugin runs its code
                self._off.add(name)
                LOG.warning("hook plugin %r is disabled for this run: %s: %s", name, hook, one_line(error))

    def check(self) -> None:
        """Log what each plugin says that keeps it from working, before any run."""
        for name, function, _ in self._functions.get("mrpbench_check", ()):
            try:
                said = " ".join(str(function() or "")[:LONGEST].split())
            except BaseException as error:  # noqa: BLE001 - calling a plugin runs its code
                said = f"mrpbench_check: {one_line(error)}"
            if said:
                LOG.warning("hook plugin %r: %s", name, said)

    def _fault(self, plugin: object) -> str | None:
        """Why a registered plugin is not a hook plugin, or None."""
        callers = self._manager.get_hookcallers(plugin) or []
        for caller in callers:
            if not caller.has_spec():
                near = closest(caller.name, _SPECIFIED)
                return f"there is no hook {caller.name}" + (f"; did you mean {near}?" if near else "")
            if any(implementation.hookwrapper or implementation.wrapper for implementation in caller.get_hookimpls()):
                return f"{caller.name} is a wrapper; hooks only observe"
        return None if callers else "it implements no hook; mark functions with mrpbench_core.api.hookimpl"

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
