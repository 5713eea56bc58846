"""The context in a bag is read, or what is wrong with it is said."""

import io

import numpy as np
import pytest
from mrpbench_exporters_rosbag2.whole import unpack, unpacked


def message(**arrays):
    """The data of a message that holds these arrays."""
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)
    return np.frombuffer(file.getvalue(), np.uint8)


def test_arrays_that_would_take_too_much_memory_are_refused(monkeypatch):
    assert unpacked(message(a=np.zeros(1000)))["a"].shape == (1000,)
    monkeypatch.setattr("mrpbench_exporters_rosbag2.whole.LARGEST", 5000)
    with pytest.raises(ValueError, match="would take more than"):
        unpacked(message(a=np.zeros(1000)))


@pytest.mark.parametrize("data", [b"", b"PK", b'{"format": 1}', b'{"format": 1, "context": [[]]}', b"[" * 10**5])
def test_damage_is_one_kind_of_error(data):
    with pytest.raises(ValueError, match="damaged"):
        unpack(message(context=np.frombuffer(data, np.uint8)))
    with pytest.raises(ValueError, match="damaged"):
        unpacked(np.frombuffer(data, np.uint8))
