"""Copies that cannot be told from the original, and what is changed in them is found."""

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mrpbench_core.engine.own import Handed, difference, own
from mrpbench_core.model.common.arrays import LARGE
from mrpbench_core.testing.instances.problems import grid_of, problem_on

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


@pytest.mark.parametrize("size", [4, LARGE // 8, LARGE])
def test_arrays_of_a_copy_are_others_and_what_is_put_in_their_place_is_found(size):
    problem = attrs.evolve(PROBLEM, ready=np.arange(size))
    handed = Handed(own(problem), "the problem")
    given, kept = handed.given.ready, problem.ready
    assert given is not kept
    with pytest.raises(ValueError, match="read-only"):
        given[0] = 7
    given.shape = (2, size // 2)
    assert kept.shape == (size,), "an array is another object also where its memory is shared"
    assert difference(handed.given, problem, "it") == "it.ready"
    given.shape = (size,)
    assert difference(handed.given, problem, "it") is None
    object.__setattr__(handed.given, "ready", np.arange(1, size + 1))
    assert difference(handed.given, problem, "it") == "it.ready"


def test_nobody_can_write_to_what_copies_share():
    problem = attrs.evolve(PROBLEM, ready=np.arange(LARGE))
    given = own(own(problem)).ready
    assert np.shares_memory(given, own(problem).ready)
    for array in (given, given[:], given.view(np.uint8), given.reshape(2, -1)):
        with pytest.raises(ValueError, match="WRITEABLE"):
            array.setflags(write=True)
