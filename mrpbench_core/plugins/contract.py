"""Check, when a class is chosen, that it is a valid component."""

import inspect
import sys
import typing
from typing import Any, ClassVar

import attrs

from mrpbench_core.api.component import Component
from mrpbench_core.api.format import Format, ReadableFormat, WritableFormat

CORE = "mrpbench_core."


def violation(cls: Any, base: type[Component]) -> str | None:
    """Return why `cls` is not a component of the kind `base`, as a predicate for its name, or None."""
    if not isinstance(cls, type) or not issubclass(cls, base):
        if isinstance(cls, type) and issubclass(cls, Format) and issubclass(base, WritableFormat | ReadableFormat):
            return base.lacking
        return f"is not a subclass of {base.__name__}"
    if cls.__module__.startswith(CORE) and not is_of(cls):
        return f"says that it is of the module {cls.__module__}, where it is not"
    if inspect.isabstract(cls):
        return f"lacks the methods {', '.join(sorted(cls.__abstractmethods__))}"
    if "__attrs_attrs__" not in vars(cls) or not _frozen(cls):
        return "is not decorated @attrs.frozen(kw_only=True)"
    try:
        attrs.resolve_types(cls)  # type: ignore[type-var]
    except Exception as error:  # noqa: BLE001 - annotations are code, so anything may be raised
        return f"has an option whose type cannot be resolved: {error}"
    if any(field.alias == "plugin" for field in attrs.fields(cls)):  # type: ignore[arg-type]
        return "has an option called `plugin`, the key that chooses it"
    if strays := _stray_annotations(cls):
        return (
            f"has annotated public names that are not options: {', '.join(strays)} (write `name: type = option(...)`)"
        )
    return None


def is_of(cls: type, package: str | tuple[str, ...] = CORE) -> bool:
    """Tell whether a class is of a module whose name begins with `package`, and does not only say so."""
    if not str(cls.__module__).startswith(package):
        return False
    value: Any = sys.modules.get(cls.__module__)
    for name in cls.__qualname__.split("."):
        value = getattr(value, name, None)
    return value is cls


def _frozen(cls: type[Component]) -> bool:
    probe = object.__new__(cls)
    try:
        probe.probe = None  # type: ignore[attr-defined]
    except attrs.exceptions.FrozenInstanceError:
        return True
    except AttributeError:
        return False
    return False


def _stray_annotations(cls: type[Component]) -> list[str]:
    fields = {field.name for field in attrs.fields(cls)}  # type: ignore[arg-type]
    strays = []
    for owner in cls.__mro__:
        for name, annotation in inspect.get_annotations(owner).items():
            if not name.startswith("_") and name not in fields and not _is_class_variable(annotation):
                strays.append(name)
    return strays


def _is_class_variable(annotation: Any) -> bool:
    if isinstance(annotation, str):  # from __future__ import annotations
        return annotation.strip("'\"").removeprefix("typing.").removeprefix("t.").startswith("ClassVar")
    return annotation is ClassVar or typing.get_origin(annotation) is ClassVar
