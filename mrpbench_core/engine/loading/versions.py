"""Components and versions of everything whose change could change a run's numbers."""

import functools
from collections.abc import Iterable, Mapping
from importlib import metadata
from pathlib import Path
from typing import Any

from packaging.markers import UndefinedEnvironmentName
from packaging.requirements import InvalidRequirement, Requirement

from mrpbench_core.api.component import Component
from mrpbench_core.plugins.checkout import version_of
from mrpbench_core.plugins.installed import CORE, distribution
from mrpbench_core.plugins.provenance import origin


def code_of(components: Iterable[Component], folder: Path) -> dict[str, Any]:
    """The components and versions that a run with these components would be made with now."""
    return _code(tuple(dict.fromkeys(map(type, components))), folder)


@functools.lru_cache(maxsize=256)
def _code(classes: tuple[type[Component], ...], folder: Path) -> dict[str, Any]:
    return with_versions([origin(cls, folder) for cls in classes])


def with_versions(origins: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Components as records keep them, without their places, and versions; those of editable checkouts are of now."""
    components: list[dict[str, Any]] = []
    for component in origins:
        entry = {key: value for key, value in component.items() if key != "direct_url"}
        if "distribution" in entry:
            entry["version"] = version_of(entry["distribution"])
        components.append(entry)
    return {"components": components, "versions": versions(components)}


def versions(components: Iterable[Mapping[str, Any]]) -> dict[str, str]:
    """Versions by distribution: the core, those that offer the components, and what these require directly."""
    numbers = {name: version_of(name) for name in (CORE, "numpy")}
    for name in {entry["distribution"] for entry in components if "distribution" in entry}:
        numbers |= _with_requirements(name)
    return dict(sorted(numbers.items()))


@functools.cache
def _with_requirements(name: str) -> dict[str, str]:
    owner = distribution(name)
    numbers = {name: version_of(name)}
    if name == CORE:
        return numbers
    for text in owner.requires or ():
        try:
            requirement = Requirement(text)
            if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
                numbers[requirement.name] = version_of(requirement.name)
        except (InvalidRequirement, UndefinedEnvironmentName, metadata.PackageNotFoundError):
            continue
    return numbers
