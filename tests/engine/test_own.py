"""Copies that cannot be told from the original, and what is changed in them is found."""

import ctypes
from collections.abc import Sequence
from fractions import Fraction

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.builtin.assigners.identity import Identity
from mrpbench_core.engine.own import _LARGE as LARGE
from mrpbench_core.engine.own import Handed, _HandedCopies, difference, own, own_returned
from mrpbench_core.model.planning.problem import Problem
from mrpbench_core.testing.instances.problems import grid_of, problem_on

LIAR = Identity()
PROBLEM = problem_on(grid_of(["..."]), [0], [2])
ATOMS = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=3)
VALUES = st.recursive(
    ATOMS,
    lambda inner: st.lists(inner, max_size=3).map(tuple) | st.lists(inner, max_size=3) | st.dictionaries(ATOMS, inner),
)


def mutable(value):
    """The lists and dictionaries in a value."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, tuple | list) else ()
    return [*([value] if isinstance(value, list | dict) else []), *(found for item in inner for found in mutable(item))]


@given(VALUES)
def test_copies_are_equal_and_share_nothing_that_can_be_changed(value):
    copied = own(value)
    assert difference(copied, value, "it") is None
    ours, theirs = mutable(value), mutable(copied)
    assert len(ours) == len(theirs)
    assert not {id(it) for it in ours} & {id(it) for it in theirs}
    for container in theirs:
        container.clear()
    assert all(it in ([], {}) for it in theirs)
    assert (difference(copied, value, "it") is None) == (not any(ours))


@pytest.mark.parametrize("size", [4, LARGE])
def test_arrays_of_a_copy_are_others_and_what_is_put_in_their_place_is_found(size):
    problem = attrs.evolve(PROBLEM, ready=np.arange(size))
    handed = Handed(problem, "the problem")
    given, kept = handed.given.ready, problem.ready
    assert not np.shares_memory(given, kept)
    with pytest.raises(ValueError, match="read-only"):
        given[0] = 7
    given.shape = (2, size // 2)
    assert difference(handed.given, problem, "it") == "it.ready"
    given.shape = (size,)
    assert difference(handed.given, problem, "it") is None
    object.__setattr__(handed.given, "ready", np.arange(1, size + 1))
    assert difference(handed.given, problem, "it") == "it.ready"


def test_a_large_array_is_copied_once_as_long_as_nobody_writes_to_its_copy():
    problem = attrs.evolve(PROBLEM, ready=np.arange(LARGE))
    first, second = Handed(problem, "the problem"), Handed(problem, "the problem")
    assert first.given.ready is second.given.ready
    second.check(LIAR)
    ctypes.memset(second.given.ready.ctypes.data, 1, 8)
    assert problem.ready[0] == 0
    with pytest.raises(BrokenContractError, match=r"changed the problem\.ready"):
        second.check(LIAR)
    Handed(problem, "the problem").check(LIAR)


def test_copies_are_forgotten_with_their_originals():
    original = np.arange(LARGE)
    before = len(_HandedCopies.arrays)
    Handed([original], "it")
    assert len(_HandedCopies.arrays) == before + 1
    del original
    assert len(_HandedCopies.arrays) == before


def test_numbers_of_another_type_are_found():
    for one, other in (((1,), (True,)), ((1,), (1.0,)), ((0.0,), (-0.0,)), (((1, 2),), ((1,), (2,)))):
        assert difference(one, other, "it") == "it"
    assert difference((float("nan"), 2**70), (float("nan"), 2**70), "it") is None


class LyingFloat(float):
    def __float__(self):
        return -1.0

    def __lt__(self, other):
        return True


class LyingInt(int):
    def __int__(self):
        return -1

    __index__ = __int__


class LyingText(str):
    def __str__(self):
        return "lie"


class LyingNumber(np.float64):
    def __eq__(self, other):
        return True

    __hash__ = np.float64.__hash__


class LyingList(list):
    def __len__(self):
        return 0


class Growing(Sequence):
    """Is longer each time."""

    def __init__(self):
        self.length = 0

    def __len__(self):
        self.length += 1
        return self.length

    def __getitem__(self, index):
        if index >= self.length:
            raise IndexError
        return float(index)


@pytest.mark.parametrize(
    ("value", "plain"),
    [
        (LyingFloat(2.5), 2.5),
        (LyingInt(3), 3),
        (LyingText("truth"), "truth"),
        (LyingNumber(2.5), 2.5),
        (Fraction(1, 2), 0.5),
        (LyingList([LyingInt(3)]), [3]),
        ({LyingText("a"): LyingFloat(1.0)}, {"a": 1.0}),
        ({1, 2}, {1, 2}),
    ],
)
def test_values_of_derived_classes_become_plain_whatever_these_replace(value, plain):
    copied = own(value)
    assert type(copied) is type(plain)
    assert copied == plain
    if isinstance(plain, list | dict):
        assert [*map(type, copied)] == [*map(type, plain)]


def test_a_sequence_is_read_once():
    growing = Growing()
    growing.length = 2
    copied = own(growing)
    assert type(copied) is tuple
    assert len(copied) == len(copied)


@pytest.mark.parametrize("value", [iter([1]), object(), lambda: 1])
def test_what_is_no_data_is_refused(value):
    with pytest.raises(BrokenContractError, match="which is no data"):
        own(value)


def test_a_class_is_not_of_the_module_that_it_says():
    model = type("Problem", (Problem,), {"__module__": Problem.__module__})
    with pytest.raises(BrokenContractError, match="the class Problem instead of Problem itself"):
        own(object.__new__(model))
    number = type("float64", (np.float64,), {"__module__": "numpy"})
    assert type(own(number(1.5))) is float


def test_errors_about_what_was_returned_name_the_component():
    def unreadable(_):
        raise KeyboardInterrupt

    odd = attrs.evolve(PROBLEM)
    object.__setattr__(odd, "ready", type("Odd", (), {"__array__": unreadable})())
    with pytest.raises(BrokenContractError, match=r"^the planner returned"):
        own_returned(odd, "the planner")
