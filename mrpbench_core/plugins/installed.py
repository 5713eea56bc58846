"""List installed plugins from the metadata of distributions, without importing them."""

import functools
import importlib
import re
import sys
from collections.abc import Iterable
from email.message import Message
from importlib import metadata
from itertools import chain
from pathlib import Path
from typing import Any, cast

import attrs
from packaging.markers import UndefinedEnvironmentName
from packaging.requirements import InvalidRequirement, Requirement

from mrpbench_core.files.errors import InputError, one_line
from mrpbench_core.plugins.importing import is_interrupt, watched
from mrpbench_core.plugins.kinds import COMMANDS, GONE, PREFIX, RENAMED, group_of, kind_of

CORE = "mrpbench-core"
_NAMES_CORE = re.compile(r"\s*mrpbench[-_.]+core(?![\w.-]*\w)", re.IGNORECASE).match


@attrs.frozen
class Provider:
    """A plugin that a distribution offers under a name."""

    name: str
    kind: str
    group: str
    distribution: str
    version: str
    value: str
    """`package.module:Class`."""
    problem: str | None = None
    """The reason why it does not work with this core, or None; known before the import."""

    @property
    def origin(self) -> str:
        """Distribution and version, for errors."""
        return f"{self.distribution} {self.version}"

    @property
    def advice(self) -> str | None:
        """A line about a group of earlier releases, which is read until the next one; None for other groups."""
        if self.kind not in RENAMED.values() or self.group == group_of(self.kind):
            return None
        return (
            f"{self.origin} offers {self.kind} {self.name!r} in the group {self.group}, which the next release does not"
            f" read: it is now {group_of(self.kind)}"
        )


def installed() -> tuple[Provider, ...]:
    """Return all components and hooks of installed distributions, by kind and name."""
    return tuple(provider for group in sorted(_scan(_path())) if group != COMMANDS for provider in providers(group))


def providers(group: str) -> tuple[Provider, ...]:
    """Return the plugins of one group, by name."""
    return _scan(_path()).get(group, ())


@functools.cache
def load(provider: Provider) -> Any:
    """Import the object that a provider offers.

    Raises:
        InputError: the import fails; the error names distribution, version and cause.
    """
    module, _, path = provider.value.partition("[")[0].partition(":")
    name = f"{provider.kind} {provider.name!r} of {provider.origin}"
    with watched(name):
        try:
            value: Any = importlib.import_module(module.strip())
            for attribute in filter(None, path.strip().split(".")):
                value = getattr(value, attribute)
        except BaseException as error:
            if is_interrupt(error):
                raise
            raise InputError(f"{name} cannot be imported: {one_line(error)}") from error
        return value


def refresh() -> None:
    """Read the metadata again, for a process in which packages are installed."""
    importlib.invalidate_caches()
    _scan.cache_clear()
    load.cache_clear()


def distribution(name: str) -> metadata.Distribution:
    """Return the distribution of a `Provider.distribution`."""
    return metadata.distribution(name)


def entry_points() -> list[metadata.EntryPoint]:
    """Return all entry points in the groups of mrpbench, except those of distributions that `unreadable` names."""
    try:
        installed = metadata.entry_points()
    except Exception:  # noqa: BLE001 - one distribution with damaged metadata must not cost the others
        return [entry for entry in _one_by_one()[0] if entry.group.startswith(PREFIX)]
    return [entry for group in installed.groups if group.startswith(PREFIX) for entry in installed.select(group=group)]


def unreadable() -> dict[str, str]:
    """Return why the entry points of a distribution cannot be read, by the folder of its metadata."""
    try:
        metadata.entry_points()
    except Exception:  # noqa: BLE001 - as above
        return _one_by_one()[1]
    return {}


def _one_by_one() -> tuple[list[metadata.EntryPoint], dict[str, str]]:
    """All entry points, read in spite of distributions with damaged metadata, and what is wrong with these."""
    entries: dict[str, list[metadata.EntryPoint]] = {}
    faults = {}
    for owner in metadata.distributions():
        try:
            facts = _facts(owner)  # the first distribution of a name is the one that is imported
            entries.setdefault(facts["distribution"], list(owner.entry_points))
        except Exception as error:  # noqa: BLE001 - a file that is not text, a link to itself, and what else there may be
            faults[_folder(owner)] = f"has entry points that cannot be read: {one_line(error)}"
    return list(chain.from_iterable(entries.values())), faults


def _folder(owner: metadata.Distribution) -> str:
    """The name of the folder of a distribution's metadata."""
    return Path(str(getattr(owner, "_path", "unknown"))).name


def _path() -> tuple[str, ...]:
    return tuple(sys.path)


@functools.lru_cache(maxsize=4)
def _scan(_: tuple[str, ...]) -> dict[str, tuple[Provider, ...]]:
    providers_of: dict[str, set[Provider]] = {}
    owners: dict[int, dict[str, Any]] = {}
    for entry in entry_points():
        if (owner := entry.dist) is not None:
            if id(owner) not in owners:  # a distribution may offer many plugins
                owners[id(owner)] = _facts(owner)
            facts, kind = owners[id(owner)], kind_of(entry.group)
            facts = facts | {"problem": facts["problem"] or GONE.get(kind)}
            provider = Provider(name=entry.name, kind=kind, group=entry.group, value=entry.value, **facts)
            providers_of.setdefault(entry.group, set()).add(provider)

    def order(provider: Provider) -> tuple[str, str, str]:
        return provider.name, provider.distribution, provider.value

    return {group: tuple(sorted(offers, key=order)) for group, offers in providers_of.items()}


def _facts(owner: metadata.Distribution) -> dict[str, Any]:
    """What the plugins of one distribution have in common, as fields of `Provider`."""
    try:
        facts = cast("Message", owner.metadata)  # the declared type is a protocol
        name, version = facts.get("Name"), facts.get("Version")
        problem = _fault(name, version) or incompatibility(owner.requires or ())
    except Exception as error:  # noqa: BLE001 - as above
        name, version, problem = None, None, f"has metadata that cannot be read: {one_line(error)}"
    return {"distribution": name or _folder(owner), "version": version or "unknown", "problem": problem}


def _fault(name: str | None, version: str | None) -> str | None:
    """Return why records could not say which distribution and version was used, or None."""
    if not name or not version:
        return "has metadata without a name or a version"
    try:
        metadata.distribution(name)
    except metadata.PackageNotFoundError:
        return "is not found by the name in its metadata"
    return None


def incompatibility(requires: Iterable[str]) -> str | None:
    """Return why a distribution with these requirements does not work with this core, or None."""
    for text in requires:
        if not _NAMES_CORE(text):  # to parse all requirements of all distributions takes longer than the rest
            continue
        try:
            requirement = Requirement(text)
            applies = requirement.marker is None or requirement.marker.evaluate({"extra": ""})
        except (InvalidRequirement, UndefinedEnvironmentName):
            continue  # concerns another package, or pip would have refused it
        if applies:
            version = metadata.version(CORE)
            if not requirement.specifier.contains(version, prereleases=True):
                return f"needs {CORE}{requirement.specifier}, this is {version}: install versions that fit"
    return None
