"""Loads the file of a policy."""

from pathlib import Path

from mrpbench_core.api import InputError
from mrpbench_policies.acting.acting import Acting
from mrpbench_policies.acting.onnx_model import OnnxModel
from mrpbench_policies.acting.python_class import PythonClass
from mrpbench_policies.observations import Observation

LARGEST = 256 << 20
"""Bytes of a file."""


def load(file: Path, observation: Observation, shape: tuple[int, int]) -> Acting:
    """Return the policy of a file: an ONNX model (`.onnx`), or the class `Policy` of a Python file (`.py`).

    `shape` is that of the map, rows and columns.

    Raises:
        InputError: the file is missing, too large, of another kind, or does not fit the observation.
    """
    fields = observation.fields(shape)
    try:
        size = file.stat().st_size
        if size > LARGEST:
            raise InputError(f"has {size >> 20} MiB; the file of a policy has at most {LARGEST >> 20} MiB", file=file)
        content = file.read_bytes()
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", file=file) from None
    if file.suffix == ".onnx":
        return OnnxModel(file, content, fields)
    if file.suffix == ".py":
        return PythonClass(file, content)
    raise InputError("is neither an ONNX model (.onnx) nor a Python file (.py)", file=file)
