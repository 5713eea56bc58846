import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from mrpbench_replay.packing import LARGEST, Packing, quantise

INT32 = st.integers(-(2**31), 2**31 - 1)


@settings(deadline=None, max_examples=60)
@given(values=arrays("i4", array_shapes(min_dims=1, max_dims=2, max_side=6), elements=INT32))
def test_whole_numbers_come_back(unpack, values):
    packing = Packing()
    packing.add("first", [[1, 2], [3, 4]])
    packing.add("values", values)
    found = unpack(packing.layout, packing.text())
    assert np.array_equal(found["values"], values)
    assert found["first"].tolist() == [[1, 2], [3, 4]]


@settings(deadline=None, max_examples=60)
@given(values=arrays("f8", (3, 5), elements=st.floats(-1e5, 1e5)), quantum=st.sampled_from([0.001, 0.01]))
def test_lengths_come_back_within_half_a_quantum(unpack, values, quantum):
    packing = Packing()
    packing.add_metres("values", values, quantum)
    assert np.abs(unpack(packing.layout, packing.text())["values"] - values).max() <= quantum / 2 + 1e-9


@pytest.mark.parametrize("low", [-4e6, 0.0, 5e9])
def test_coordinates_far_from_the_origin_keep_their_precision(low):
    values = low + np.linspace(0, 500, 11)
    steps, scale, offset = quantise(values, 0.001)
    assert np.abs(steps.astype("i8")).max() <= LARGEST
    assert np.abs(offset + scale * steps - values).max() < 0.001


def test_a_world_too_large_for_32_bits_becomes_coarser_not_wrong():
    values = np.array([0.0, 1e9, 4e9])
    steps, scale, offset = quantise(values, 0.001)
    assert np.abs(offset + scale * steps - values).max() <= scale / 2


def test_steady_motion_packs_to_almost_nothing():
    packing = Packing()
    packing.add_metres("x", np.outer(np.linspace(0.1, 1, 100), np.arange(1000) / 10))
    assert len(packing.text()) < 0.1 * 100 * 1000


def test_nothing_can_be_packed(unpack):
    packing = Packing()
    packing.add("a", np.empty((0, 4)))
    packing.add("b", np.empty((3, 0)))
    packing.add_metres("c", np.empty(0))
    found = unpack(packing.layout, packing.text())
    assert [found[name].shape for name in "abc"] == [(0, 4), (3, 0), (0,)]


def test_types_are_as_narrow_as_the_values(unpack):
    packing = Packing()
    for name, values in {"u1": [0, 255], "i2": [0, 256], "also_i2": [-1, 5], "i4": [0, 40000]}.items():
        packing.add(name, values)
    assert [entry["type"] for entry in packing.layout.values()] == [
        "Uint8Array",
        "Int16Array",
        "Int16Array",
        "Int32Array",
    ]
