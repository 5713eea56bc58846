"""Base of every plugin: an immutable recipe whose attrs fields are its options."""

from abc import ABC
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, ClassVar

import attrs


def option(
    default: Any = attrs.NOTHING,
    *,
    help: str,  # the word that users know
    unit: str | None = None,
    validator: Callable[..., Any] | None = None,
) -> Any:
    """Declare one option of a component.

    Args:
        default: value if the configuration does not name the option; an option without a default is required.
        help: one sentence for `mrpbench plugins show`, the JSON Schema and editors.
        unit: `s`, `m`, `m/s`, `rad/s`, `Hz` or `B`. A numeric option with a unit also accepts text such as `"30 s"`,
            `"5 min"` or `"4 GiB"`; the field always holds the SI number.
        validator: an attrs validator, e.g. `attrs.validators.ge(1)`.

    A field of type `pathlib.Path` names a file, relative to the folder of the configuration; its content identifies it.
    A field whose type is a component class (or a tuple of one) is chosen by plugin name, recursively.
    """
    return attrs.field(default=default, validator=validator, metadata={"help": help, "unit": unit})


class Component(ABC):
    """Base of every kind. A concrete component is decorated `@attrs.frozen(kw_only=True)`.

    State (a physics world, a controller on its path) belongs to a *session* that the recipe returns.
    """

    group: ClassVar[str]
    """Entry-point group of the kind, e.g. `mrpbench.planners`."""
    live: ClassVar[bool] = False
    """True if something outside with a clock of its own takes part; such runs are marked and are not repeatable."""

    suite: ClassVar[str | None] = None
    """The conformance suite of a kind that a plugin defines, as `package.module:Class`; the class of the kind sets it.

    It derives from `mrpbench_core.testing.ComponentConformance` and is imported for `mrpbench check` only."""

    def idle_options(self) -> Mapping[str, str]:
        """Return options that have no effect with the values of the others, each with the reason.

        A configuration that names one is told so before its runs.
        """
        return {}

    def reads(self) -> tuple[Path, ...]:
        """Return files that the component reads besides those of its options, e.g. because one of these names them.

        Their content is part of the identity of runs. Missing files are left out.
        """
        return ()


__all__ = ["Component", "Path", "option"]
