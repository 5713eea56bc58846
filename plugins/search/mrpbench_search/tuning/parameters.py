"""The parameters of a tuning: options with their defaults and ranges.

A number goes over the range that the user states, else over the usual one of its option, widened to the default, else
from a quarter to four times its default as far as its option allows; on a logarithmic scale unless it may be 0. An
option with few values takes each of them.
"""

import math
import re
import typing
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import attrs

from mrpbench_core.config.unpacking import unpack
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_core.report.reading.axes import SAMPLES

FACTOR = 4.0
"""Between the default of a number and the ends of its range."""
NUMBER = r"(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?"
_RANGE = re.compile(rf"(-?{NUMBER})\.\.(-?{NUMBER})")


@attrs.frozen(kw_only=True)
class Parameter:
    """An option that is varied."""

    key: str
    """Dotted, as in a study."""
    default: Any
    low: float = math.nan
    """Of numbers."""
    high: float = math.nan
    log: bool = False
    choices: tuple[Any, ...] = ()
    """Of others."""

    @property
    def whole(self) -> bool:
        """It is a whole number."""
        return type(self.default) is int and not self.choices

    def __str__(self) -> str:
        if self.choices:
            return f"{self.key}={','.join(map(str, self.choices))}"
        return f"{self.key}={self.low:g}..{self.high:g}"


def read_parameters(point: StudyRun, texts: Sequence[str]) -> list[Parameter]:
    """Return the parameters that a user names, or the real numbers of the controller: those with a usual range, if any.

    Args:
        point: a run of the study; gives the defaults.
        texts: `controller.k_phi`, `controller.k_phi=0.5..4` or `planner.order=given,longest_first`.

    Raises:
        InputError: an option does not exist, cannot vary, or has no range of its own.
    """
    keys = [text.partition("=")[0] for text in texts]
    if repeated := [key for key in keys if keys.count(key) > 1]:
        raise InputError(f"--vary {repeated[0]}: named twice")
    found = in_worker("the options cannot be read", describe_parameters, point.parcel, list(texts))
    if not found:
        raise InputError("--vary: the controller has no numbers with defaults", hint="name options to vary")
    return [Parameter(**{**each, "choices": tuple(each["choices"])}) for each in found]


def describe_parameters(parcel: Mapping[str, Any], texts: Sequence[str]) -> list[dict[str, Any]]:
    """In a worker process: the parameters as plain data; see `read_parameters`."""
    config = unpack(parcel)
    if texts:
        return [attrs.asdict(_named(config, text)) for text in texts]
    controller: Any = config.controller
    fields = attrs.fields(type(controller)) if controller is not None else ()
    defaults = {field.alias: _default(controller, field) for field in fields}
    numbers = [field for field in fields if type(defaults[field.alias]) is float and defaults[field.alias] > 0]
    known = [field for field in numbers if field.metadata.get("usual")]
    return [
        attrs.asdict(_parameter(f"controller.{field.alias}", field, defaults[field.alias], ""))
        for field in known or numbers
    ]


def _named(config: Any, text: str) -> Parameter:
    key, _, values = text.partition("=")
    owner, steps = config, key.strip().split(".")
    for step in steps[:-1]:
        inside = isinstance(owner, tuple) and step.isdigit() and int(step) < len(owner)
        owner = owner[int(step)] if inside else getattr(owner, step, None)
    fields = {field.alias: field for field in attrs.fields(type(owner))} if attrs.has(type(owner)) else {}
    if key in SAMPLES:
        raise InputError(f"--vary {key}: all settings have the same seeds and repeats")
    if steps[-1] not in fields:
        hint = did_you_mean(steps[-1], list(fields)) if fields else "e.g. controller.k_phi"
        raise InputError(f"--vary {key}: the study has no such option", hint=hint)
    field = fields[steps[-1]]
    return _parameter(key.strip(), field, _default(owner, field), values.strip())


def _default(owner: Any, field: Any) -> Any:
    """The value of an option in the study; where it is left to Nav2, that of its file or the default of Nav2."""
    value = getattr(owner, field.name)
    if value is None and "nav2" in field.metadata:
        value = owner.read()[0].get(field.name) if hasattr(owner, "read") else field.metadata["nav2"]
    return value


def _parameter(key: str, field: Any, default: Any, values: str) -> Parameter:
    def allows(value: Any) -> bool:
        try:
            if field.validator is not None:
                field.validator(None, field, value)
        except (ValueError, TypeError):
            return False
        return True

    if not isinstance(default, bool | int | float | str):
        nothing = f"state one in the study, e.g. {key}=1"
        hint = nothing if default is None else "name one of its options; `mrpbench choose` compares components"
        raise InputError(f"--vary {key}: its value in the study is neither a number nor a word", hint=hint)
    found, literals = _RANGE.fullmatch(values), _literals(field.type)
    if not found and (values or isinstance(default, bool) or literals):
        stated = [_word(word.strip(), default) for word in values.split(",")] if values else literals or (False, True)
        if len(choices := tuple(dict.fromkeys((default, *stated)))) < 2 or len(stated) < 2:
            raise InputError(f"--vary {key}: give two values or more, or a range such as 0.5..4")
        return Parameter(key=key, default=default, choices=choices)
    whole = type(default) is int
    if found:
        low, high = float(found[1]), float(found[2])
        if whole and not (low.is_integer() and high.is_integer()):
            raise InputError(f"--vary {key}: the ends of {values} are not whole numbers")
    elif usual := field.metadata.get("usual"):
        low, high = min(usual[0], default), max(usual[1], default)
    else:
        low, high = _range(key, default, allows)
    if low >= high:
        raise InputError(f"--vary {key}: the range {low:g}..{high:g} is empty")
    if not isinstance(default, int | float) or not low <= default <= high:
        raise InputError(
            f"--vary {key}: {low:g}..{high:g} does not contain {default}, with which the search begins",
            hint="widen the range, or state another value in the study",
        )
    for end in (low, high):
        if not allows(int(end) if whole else end):
            raise InputError(f"--vary {key}: its option does not allow {end:g}")
    return Parameter(key=key, default=default, low=low, high=high, log=low > 0)


def _literals(kind: Any) -> tuple[Any, ...]:
    """The values of a choice, without None."""
    members = typing.get_args(kind)
    if typing.get_origin(kind) is typing.Literal:
        return members
    return next((values for member in members if (values := _literals(member))), ())


def _word(text: str, default: Any) -> Any:
    if isinstance(default, bool):
        return {"true": True, "false": False}.get(text.lower(), text)
    try:
        return int(text) if type(default) is int else float(text)
    except ValueError:
        return text


def _range(key: str, default: Any, allows: Callable[[Any], bool]) -> tuple[float, float]:
    """From a quarter to four times a positive default, as far as allowed."""
    if not isinstance(default, int | float) or default <= 0:
        raise InputError(f"--vary {key}: its default is {default!r}, so give a range", hint=f"e.g. {key}=0.1..1")
    whole = type(default) is int

    def bound(far: float) -> float:
        near = float(default)
        for _ in range(40):
            if allows(round(far) if whole else far):
                return float(round(far)) if whole else float(f"{far:.4g}")
            far = (near + far) / 2
        return near

    return bound(default / FACTOR), bound(default * FACTOR)
