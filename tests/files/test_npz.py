"""Arrays of `.npy` files that may be damaged."""

import zipfile
from io import BytesIO

import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra import numpy as arrays

from mrpbench_core.files.npz import read_array, read_entry


def written(array, **more):
    file = BytesIO()
    np.save(file, array, **more)
    return file.getvalue()


@given(arrays.arrays(arrays.scalar_dtypes(), arrays.array_shapes(min_dims=0, min_side=0)))
def test_what_numpy_writes_is_read_as_numpy_reads_it(array):
    for order in "CF":
        content = written(np.asarray(array, order=order))
        found, expected = read_array(content), np.load(BytesIO(content))
        assert found.dtype == expected.dtype
        assert found.shape == expected.shape
        assert found.flags.writeable
        assert found.tobytes() == expected.tobytes()


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"PK\3\4",
        written(np.arange(4))[:-1],
        written(np.arange(4))[:9],
        written(np.arange(4)).replace(b"(4,)", b"(-1,)").replace(b" \n", b"\n"),
        written(np.arange(4)).replace(b"(4,), ", b"(2**99,)"),
        written(np.array([{}], object), allow_pickle=True),
    ],
)
def test_damaged_arrays_and_objects_are_refused(content):
    with pytest.raises(ValueError):  # noqa: PT011 - NumPy's own words
        read_array(content)


def test_methods_that_decompress_without_a_bound_are_refused():
    file = BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_BZIP2) as target:
        target.writestr("a.npy", bytes(1000))
    with zipfile.ZipFile(file) as source, pytest.raises(ValueError, match="compressed by the method 12"):
        read_entry(source, source.getinfo("a.npy"))
