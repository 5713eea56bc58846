"""The complete context of the run as one message: `/run_data` holds a NumPy `.npz` file.

It has the entry `context`, the UTF-8 bytes of `{"format": 1, "context": …}` in JSON, and the arrays that this names.
"""

import json
from collections.abc import Mapping
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.files.codec import decode, encode
from mrpbench_core.model.runs.run import RunContext
from mrpbench_exporters_rosbag2.messages import Topic, message, serialize

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
    try:
        with np.load(BytesIO(data.tobytes()), allow_pickle=False) as file:
            said = json.loads(file["context"].tobytes())
            if said["format"] != FORMAT:
                raise ValueError(f"format {said['format']}, this version reads {FORMAT}")
            return decode(said["context"], RunContext, file.__getitem__)
    except ValueError:
        raise
    except Exception as error:  # zip, JSON and cattrs have no common class of errors
        raise ValueError(f"damaged: {error}") from error
