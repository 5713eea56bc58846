"""Copies of what crosses between the engine and components, so that the engine judges by data that no component holds.

Read-only arrays and frozen classes keep a component from changing its inputs by mistake; they do not keep it from
changing them on purpose.
"""

import enum
import marshal
import numbers
import weakref
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import chain
from pathlib import PurePath
from types import MemberDescriptorType
from typing import Any, ClassVar, Generic, TypeVar

import attrs
import numpy as np

from mrpbench_core.api.component import Component
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.files.errors import one_line
from mrpbench_core.model.common.arrays import ARRAY, read_only
from mrpbench_core.model.common.plain import plain_bytes
from mrpbench_core.plugins.contract import is_of
from mrpbench_core.plugins.kinds import kind_of
from mrpbench_core.plugins.provenance import components_in, is_of_others

T = TypeVar("T")
_PLAIN: dict[type, Any] = {int: int.__int__, float: float.__float__, str: str.__str__}
"""How a value of a class that is derived from these becomes one of these, whatever methods the class replaces."""
_CONTAINERS = (tuple, list, frozenset, set)
_OURS = ("mrpbench_core.", "numpy")
"""Modules whose classes compare and convert as they should."""
_ATOMS = frozenset({bool, int, float, str, type(None)})
_NUMBERS = _ATOMS - {str}
_LARGE = 1 << 14
"""Bytes of an array that is not copied again for each call, and is compared without copies."""
_KNOWN_FIELDS: dict[type, tuple[tuple[str, str], ...]] = {}
_SLOTS: dict[type, tuple[tuple[Any, ...], ...] | None] = {}


def own(value: T, like: T | None = None) -> T:
    """Return a copy that shares no array, no container and no object of `mrpbench_core.model` with `value`.

    Arrays of whole numbers of an object that are equal to those of `like`, an older copy, are taken from there, so that
    the same array says that nothing has changed.

    Raises:
        BrokenContractError: an object is of a class that is derived from one of the model.
    """
    known = _Copies()
    copied: T = _own_object(value, known, like) if type(value) in _SLOTS else _own(value, known)
    return copied


def own_returned(value: T, by: str, like: T | None = None) -> T:
    """Return a copy as `own` does of what a component returned; `by` names it, as in `the localizer`.

    Raises:
        BrokenContractError: it cannot be copied, because it is not what it seems to be.
    """
    try:
        return own(value, like)
    except BrokenContractError as error:
        raise BrokenContractError(str(error).replace("a component", by, 1)) from error
    except MemoryError:
        raise
    except BaseException as error:  # values may have methods of the component
        raise BrokenContractError(f"{by} returned what cannot be copied: {one_line(error)}") from error


class _Copies(dict[int, Any]):
    """Originals and their copies, by the id of the original."""

    def of_array(self, array: np.ndarray) -> np.ndarray:
        return read_only(array.copy())


class _HandedCopies(_Copies):
    """A large array of the engine, which never changes, is copied once for all calls."""

    arrays: ClassVar[dict[int, tuple[Any, np.ndarray]]] = {}

    def of_array(self, array: np.ndarray) -> np.ndarray:
        if array.nbytes < _LARGE:
            return super().of_array(array)
        if (found := self.arrays.get(id(array))) is None:
            forget = partial(self.arrays.pop, id(array))
            found = self.arrays[id(array)] = weakref.ref(array, lambda _: forget(None)), super().of_array(array)
        return found[1]


def _own(value: Any, known: _Copies) -> Any:
    kind = type(value)
    if kind is np.ndarray:  # the usual cases in every control period come first
        return known.of_array(value)
    if kind in _ATOMS:
        return value
    if kind is tuple:
        if _holds_numbers(value):
            return marshal.loads(plain_bytes(value))  # noqa: S302 - what was dumped just now
        return tuple([_own(item, known) for item in value])
    if kind is dict:
        return {_own(key, known): _own(item, known) for key, item in value.items()}
    if _is_object(kind):
        if (found := known.get(id(value))) is None:
            found = known[id(value)] = value, _own_object(value, known)  # the original is kept: its id stays its own
        return found[1]
    return _own_other(value, known)


def _holds_numbers(value: tuple[Any, ...]) -> bool:
    """Tell whether a tuple holds nothing but numbers, or tuples of these: thousands of them cross for each plan."""
    items: Sequence[Any] = value
    while items and set(map(type, items)) == {tuple}:
        items = [*chain.from_iterable(items)]
    return _NUMBERS.issuperset(map(type, items))


def _own_other(value: Any, known: _Copies) -> Any:
    kind = type(value)
    if isinstance(value, np.ndarray):
        return _own(np.array(value, subok=False), known)
    if isinstance(value, type) or (isinstance(value, enum.Enum | np.generic) and is_of(kind, _OURS)):
        return value
    for plain, convert in _PLAIN.items():
        if isinstance(value, plain):
            return convert(value)
    if hasattr(kind, "_fields") and is_of(kind, _OURS):
        return kind(*[_own(item, known) for item in value])
    for container in _CONTAINERS:
        if isinstance(value, container):
            return container([_own(item, known) for item in value])
    if isinstance(value, Mapping):
        return {_own(key, known): _own(item, known) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, bytes):
        return tuple([_own(item, known) for item in value])
    if isinstance(value, numbers.Real):
        return float(value)
    if kind is bytes or isinstance(value, PurePath):
        return value
    raise BrokenContractError(f"a component returned an object of the class {kind.__name__}, which is no data")


def _own_object(value: Any, known: _Copies, like: Any = None) -> Any:
    kind = type(value)
    if kind not in _SLOTS:
        _SLOTS[kind] = _slots(kind)
    slots = _SLOTS[kind]
    if slots is None:
        return kind(**{alias: _own(getattr(value, name), known) for alias, name in _fields(kind)})
    copied = object.__new__(kind)  # `__init__` would take three times as long, in every control period
    for read, write, dtype, tail, convert, is_whole in slots:
        item = read(value)
        if type(item) is np.ndarray and item.dtype is dtype and (tail is None or item.shape[1:] == tail):
            if like is not None and is_whole and _same(item, found := read(like)):
                item = found
            else:
                item = known.of_array(item)
        elif type(item) not in _ATOMS or convert is not None:
            item = _own(item, known)
            if convert is not None:
                item = convert(item)
        write(copied, item)
    return copied


def _is_object(kind: type) -> bool:
    return kind in _SLOTS or attrs.has(kind)


def _slots(kind: type) -> tuple[tuple[Any, ...], ...] | None:
    """How each field is read, written, and converted, None if only `__init__` can make an object.

    Raises:
        BrokenContractError: the class is not one of the model.
    """
    if not is_of(kind, "mrpbench_core.model."):
        base = next((cls.__name__ for cls in kind.__mro__ if cls.__module__.startswith("mrpbench_core.model.")), "it")
        raise BrokenContractError(f"a component returned the class {kind.__name__} instead of {base} itself")
    fields = attrs.fields(kind)
    slots = [getattr(kind, field.name, None) for field in fields]
    if (
        hasattr(kind, "__attrs_post_init__")
        or hasattr(kind, "_attrs_cached_hash")
        or not all(
            isinstance(slot, MemberDescriptorType) and field.init and field.validator is None
            for slot, field in zip(slots, fields, strict=True)
        )
    ):
        return None
    return tuple(_access(slot, field) for slot, field in zip(slots, fields, strict=True))


def _access(slot: Any, field: Any) -> tuple[Any, ...]:
    dtype, columns = field.metadata.get(ARRAY, (None, None))
    is_whole = dtype is not None and dtype.kind in "iub"
    return slot.__get__, slot.__set__, dtype, columns and (columns,), field.converter, is_whole


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two arrays of one type are equal bit for bit."""
    if one.shape != other.shape:
        return False
    if one.nbytes >= _LARGE and one.dtype.kind in "iufb":
        word = np.int64 if one.itemsize == 8 else np.uint8
        return bool((one.view(word) == other.view(word)).all())  # a third of the time of copies
    return one.tobytes() == other.tobytes()


def _fields(kind: type) -> tuple[tuple[str, str], ...]:
    """Alias and name of each field that `__init__` takes."""
    if kind not in _KNOWN_FIELDS:
        _KNOWN_FIELDS[kind] = tuple((field.alias, field.name) for field in attrs.fields(kind) if field.init)
    return _KNOWN_FIELDS[kind]


def difference(given: Any, kept: Any, name: str) -> str | None:
    """Return where `given` differs from `kept`, as in `problem.goals`, or None."""
    if given is kept:
        return None
    kind = type(kept)
    if type(given) is not kind:
        return name
    if kind in _ATOMS:
        return None if given == kept or (given != given and kept != kept) else name
    if kind is np.ndarray:
        return None if given.dtype == kept.dtype and _same(given, kept) else name
    if kind is not tuple and _is_object(kind):
        return _difference_in_fields(given, kept, name)
    if kind is tuple and _holds_numbers(kept) and _holds_numbers(given):
        return None if plain_bytes(given) == plain_bytes(kept) else name
    if isinstance(kept, tuple | list):
        if len(given) != len(kept):
            return name
        pairs = zip(given, kept, strict=True)
        return next((where for one, other in pairs if (where := difference(one, other, name))), None)
    if isinstance(kept, Mapping):
        if given.keys() != kept.keys():
            return name
        return next((where for key in kept if (where := difference(given[key], kept[key], name))), None)
    return None if given == kept else name


def _difference_in_fields(given: Any, kept: Any, name: str) -> str | None:
    for _, field in _fields(type(kept)):
        ours, theirs = getattr(kept, field), getattr(given, field)
        if ours is not theirs and (where := difference(theirs, ours, f"{name}.{field}")):
            return where
    return None


def name_of(component: Component) -> str:
    """The name of a component in messages about its contract."""
    return f"the {kind_of(component.group)} {type(component).__name__}"


class Handed(Generic[T]):
    """A copy that components are given, beside what the engine keeps."""

    def __init__(self, kept: T, name: str) -> None:
        self._kept = kept
        self._name = name
        self.given: T = _own(kept, _HandedCopies())

    def check(self, component: Component, *others: Component) -> None:
        """Require that the copy is unchanged.

        Args:
            component: has just been called.
            others: components that it calls, besides those that are options of it.

        Raises:
            BrokenContractError: it was changed; components of other projects are named first.
        """
        if (where := difference(self.given, self._kept, self._name)) is not None:
            _HandedCopies.arrays.clear()
            called = filter(is_of_others, components_in((component, *others)))
            names = " or ".join(map(name_of, called)) or name_of(component)
            raise BrokenContractError(f"{names} changed {where}")
