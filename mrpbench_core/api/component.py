"""Base of every plugin: an immutable recipe whose attrs fields are its options."""

import math
from abc import ABC
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, ClassVar

import attrs

from mrpbench_core.model.common.units import LARGEST, LARGEST_COUNT, LARGEST_NUMBER


def option(
    default: Any = attrs.NOTHING,
    *,
    help: str,  # the word that users know
    unit: str | None = None,
    validator: Callable[..., Any] | None = None,
    infinite: bool = False,
    former: str | None = None,
) -> Any:
    """Declare one option of a component.

    Args:
        default: value if the configuration does not name the option; an option without a default is required.
        help: one sentence for `mrpbench plugins show`, the JSON Schema and editors.
        unit: `s`, `m`, `m/s`, `rad/s`, `Hz` or `B`. A numeric option with a unit also accepts text such as `"30 s"`,
            `"5 min"` or `"4 GiB"`; the field always holds the SI number.
        validator: an attrs validator, e.g. `attrs.validators.ge(1)`.
        infinite: numbers may be infinite. Otherwise they are finite, with magnitudes up to
            `mrpbench_core.model.common.units.LARGEST`.
        former: its name in the last release; configurations may still use it, with a line of advice.

    A field of type `pathlib.Path` names a file, relative to the folder of the configuration; its content identifies it.
    A field whose type is a component class (or a tuple of one) is chosen by plugin name, recursively.
    """
    metadata = {"help": help, "unit": unit, "former": former}
    return attrs.field(default=default, validator=bounded(unit, validator, infinite=infinite), metadata=metadata)


def bounded(
    unit: str | None, validator: Callable[..., Any] | None = None, *, infinite: bool = False
) -> Callable[..., Any]:
    """Return the validator of an option: no number is so large that computations with it fail, and `validator`."""
    check: Callable[..., Any] = _Magnitude(unit, infinite)
    return check if validator is None else attrs.validators.and_(check, validator)


@attrs.frozen
class _Magnitude:
    unit: str | None
    infinite: bool

    def __call__(self, _: Any, field: "attrs.Attribute[Any]", value: Any) -> None:
        if isinstance(value, tuple):
            for item in value:
                self(_, field, item)
        if not isinstance(value, int | float) or (self.infinite and math.isinf(value)):
            return
        unit = self.unit or ""
        most = LARGEST_COUNT if isinstance(value, int) else LARGEST.get(unit, LARGEST_NUMBER)
        if not abs(value) <= most:
            bound = f"at most {most:g}" if value > 0 else f"at least -{most:g}"
            raise ValueError(f"{field.name!r} must be {bound} {unit}".rstrip() + f", got {value:g}")


def between(least: float, most: float) -> Callable[..., Any]:
    """Return a validator of numbers from `least` to `most`."""
    return attrs.validators.and_(attrs.validators.ge(least), attrs.validators.le(most))


class Component(ABC):
    """Base of every kind. A concrete component is decorated `@attrs.frozen(kw_only=True)`.

    State (a physics world, a controller on its path) belongs to a *session* that the recipe returns.
    """

    group: ClassVar[str]
    """Entry-point group of the kind, e.g. `mrpbench.planners`."""
    live: ClassVar[bool] = False
    """True if something outside with a clock of its own takes part; such runs are marked and are not repeatable."""

    reserved: ClassVar[frozenset[str]] = frozenset()
    """Names that no component of the kind may have."""

    suite: ClassVar[str | None] = None
    """The conformance suite of a kind that a plugin defines, as `package.module:Class`; the class of the kind sets it.

    It derives from `mrpbench_core.testing.ComponentConformance` and is imported for `mrpbench check` only."""

    def idle_options(self) -> Mapping[str, str]:
        """Return options that have no effect with the values of the others, each with the reason.

        A configuration that names one is told so before its runs.
        """
        return {}

    def notes(self) -> tuple[str, ...]:
        """Return what the user should know of the files of its options before the runs, one line each."""
        return ()

    def reads(self) -> tuple[Path, ...]:
        """Return files that the component reads besides those of its options, e.g. because one of these names them.

        Their content is part of the identity of runs. Missing files are left out.
        """
        return ()


__all__ = ["Component", "Path", "between", "option"]
