"""What every plugin is: an immutable recipe whose attrs fields are its options."""

from abc import ABC
from collections.abc import Callable
from pathlib import Path
from typing import Any, ClassVar

import attrs


def option(
    default: Any = attrs.NOTHING,
    *,
    help: str,  # the word users know it by
    unit: str | None = None,
    validator: Callable[..., Any] | None = None,
) -> Any:
    """Declare one option of a component.

    Args:
        default: value when the configuration does not name the option; without one the option is required.
        help: one sentence for `mrpbench plugins show`, the JSON Schema and editors.
        unit: `s`, `m`, `m/s`, `rad/s`, `Hz` or `B`. A numeric option with a unit also accepts text such as `"30 s"`,
            `"5 min"` or `"4 GiB"`; the field always holds the SI number.
        validator: an attrs validator, e.g. `attrs.validators.ge(1)`.

    A field typed `pathlib.Path` names a file: it is resolved against the configuration's folder and identified by its
    content. A field typed with a component class (or a tuple of one) is chosen by plugin name, recursively.
    """
    return attrs.field(default=default, validator=validator, metadata={"help": help, "unit": unit})


class Component(ABC):
    """Base of every kind. A concrete component is decorated `@attrs.frozen(kw_only=True)`.

    What has state (a physics world, a controller that follows one path) is a *session* that the recipe returns.
    """

    group: ClassVar[str]
    """Entry-point group of the kind, e.g. `mrpbench.planners`."""
    live: ClassVar[bool] = False
    """Something outside, on a clock of its own, takes part: runs with it are marked so and are not repeatable."""

    def reads(self) -> tuple[Path, ...]:
        """Files that it reads besides those of its options, say because one of these names them.

        They count for the identity of runs by their content. Those that are missing are left out.
        """
        return ()


__all__ = ["Component", "Path", "option"]
