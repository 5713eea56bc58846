"""The complete context of the run as one message: `/run_data` holds a NumPy `.npz` file.

It has the entry `context`, the UTF-8 bytes of `{"format": 1, "context": …}` in JSON, and the arrays that this names.
"""

import json
import zipfile
from collections.abc import Mapping
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.checking.context import check_context
from mrpbench_core.files.codec import decode, encode
from mrpbench_core.files.errors import one_line
from mrpbench_core.files.npz import read_array, read_entry
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.messages import Topic, message, serialize

LARGEST = 2**30
"""Bytes of all arrays of a message."""
FORMAT = 1
"""Raised when a reader of the old format would misread the new one."""
TOPIC = Topic("/run_data", "std_msgs/UInt8MultiArray", latched=True)


def whole(context: RunContext) -> tuple[Topic, bytes]:
    """The message."""
    arrays: dict[str, NDArray[Any]] = {}

    def keep(array: NDArray[Any]) -> str:
        name = f"array_{len(arrays)}"
        arrays[name] = array
        return name

    text = json.dumps({"format": FORMAT, "context": encode(context, keep)})
    arrays["context"] = np.frombuffer(text.encode(), np.uint8)
    return TOPIC, packed(arrays)


def packed(arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Arrays by name as a std_msgs/UInt8MultiArray that holds a `.npz` file."""
    file = BytesIO()
    np.savez_compressed(file, allow_pickle=False, **arrays)
    layout = message("std_msgs/MultiArrayLayout", dim=[], data_offset=0)
    data = np.frombuffer(file.getvalue(), np.uint8)
    return serialize(TOPIC.type, message(TOPIC.type, layout=layout, data=data))


def unpack(data: NDArray[np.uint8]) -> RunContext:
    """The context that `whole` packed into the message's `data`.

    Raises:
        ValueError: it is damaged, or of another format.
    """
    arrays = unpacked(data)
    context, fault = None, None
    try:
        said = json.loads(arrays["context"].tobytes())
        if said["format"] == FORMAT:
            context = decode(said["context"], RunContext, arrays.__getitem__)
            fault = check_context(context)
    except Exception as error:  # JSON and cattrs have no common class of errors
        raise ValueError(f"damaged: {one_line(error)}") from error
    if fault is not None:
        raise ValueError(f"damaged: {fault}")
    if context is None:
        raise ValueError(f"format {said['format']!r:.40}, this version reads {FORMAT}")
    return context


def unpacked(data: NDArray[np.uint8]) -> dict[str, NDArray[Any]]:
    """The arrays that `packed` packed into the message's `data`.

    Raises:
        ValueError: it is damaged, or would take more than `LARGEST` bytes.
    """
    try:
        with zipfile.ZipFile(BytesIO(data.tobytes())) as source:
            if sum(entry.file_size for entry in source.infolist()) > LARGEST:
                raise ValueError(f"damaged: it would take more than {LARGEST // 2**20} MiB")
            entries = source.infolist()
            return {entry.filename.removesuffix(".npy"): read_array(read_entry(source, entry)) for entry in entries}
    except Exception as error:  # zip, zlib and NumPy have no common class of errors
        raise ValueError(f"damaged: {one_line(error)}") from error
