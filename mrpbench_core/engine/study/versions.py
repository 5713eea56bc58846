"""Versions of everything whose change could change a run's numbers."""

import functools
from collections.abc import Iterable, Mapping
from importlib import metadata
from typing import Any

from packaging.markers import UndefinedEnvironmentName
from packaging.requirements import InvalidRequirement, Requirement

from mrpbench_core.plugins.installed import CORE, distribution
from mrpbench_core.version import __version__


def versions(components: Iterable[Mapping[str, Any]]) -> dict[str, str]:
    """Versions by distribution: the core, those that offer the components, and what these require directly."""
    found = {CORE: __version__, "numpy": metadata.version("numpy")}
    for name in {entry["distribution"] for entry in components if "distribution" in entry}:
        found |= _with_requirements(name)
    return dict(sorted(found.items()))


@functools.cache
def _with_requirements(name: str) -> dict[str, str]:
    owner = distribution(name)
    found = {name: owner.version}
    if name == CORE:
        return found
    for text in owner.requires or ():
        try:
            requirement = Requirement(text)
            if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
                found[requirement.name] = metadata.version(requirement.name)
        except (InvalidRequirement, UndefinedEnvironmentName, metadata.PackageNotFoundError):
            continue
    return found
