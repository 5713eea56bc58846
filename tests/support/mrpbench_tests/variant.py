"""Variants of components, for tests of suites: each with one fault that a check has to find."""

import sys
from typing import Any

import attrs

from mrpbench_core.api.component import Component


def variant(base: type[Any], **members: Any) -> type[Any]:
    """A component class like `base` with other methods or class attributes."""
    module = sys.modules[__name__]
    name = f"{base.__name__}{len(vars(module))}"
    made = attrs.frozen(kw_only=True)(type(name, (base,), {"__doc__": "A variant.", "__module__": __name__, **members}))
    assert issubclass(made, Component)
    setattr(module, name, made)  # where pickle and configurations look for it
    return made
