"""Fields that hold arrays take what fits and refuse what NumPy would bend until it fits."""

import numpy as np
import pytest

from mrpbench_core.model.common.arrays import frozen_array


def test_an_empty_list_has_the_columns_asked_for():
    assert frozen_array([], "f8", 3).shape == (0, 3)


@pytest.mark.parametrize("shape", [(3, 2), (6,), (2, 3, 1), ()])
def test_rows_and_columns_are_not_mixed_up(shape):
    with pytest.raises(ValueError, match="expected an array of 3 columns"):
        frozen_array(np.ones(shape), "f8", 3)


@pytest.mark.parametrize("values", [[0.5], [np.nan], [np.inf], np.array([2**32]), [2**31], [-(2**40)]])
def test_fractions_and_too_large_numbers_are_refused(values):
    with pytest.raises(ValueError, match="expected whole numbers that fit in int32"):
        frozen_array(values, "i4")


def test_whole_numbers_of_other_types_are_taken():
    for values in ([1.0, 2.0], np.array([1, 2], "u1"), [True, 2]):
        assert frozen_array(values, "i4").tolist() == [1, 2]


def test_the_copy_cannot_be_written():
    given = np.zeros(2)
    held = frozen_array(given, "f8")
    given[0] = 1
    assert held[0] == 0
    with pytest.raises(ValueError, match="read-only"):
        held[0] = 1


def test_read_only_arrays_are_kept_without_a_copy():
    held = frozen_array([1.0, 2.0], "f8")
    assert frozen_array(held, "f8") is held


def test_a_view_of_a_writable_array_is_copied():
    given = np.zeros(2)
    view = given[:]
    view.flags.writeable = False
    held = frozen_array(view, "f8")
    given[0] = 1
    assert held[0] == 0
