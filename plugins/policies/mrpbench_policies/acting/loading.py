"""Loads the file of a policy."""

from pathlib import Path

from mrpbench_core.api import InputError
from mrpbench_core.files.text import read_bytes
from mrpbench_policies.acting.acting import Acting
from mrpbench_policies.acting.onnx_model import OnnxModel
from mrpbench_policies.acting.python_class import PythonClass
from mrpbench_policies.acting.python_process import PythonProcess
from mrpbench_policies.observations import Observation


def load(
    file: Path,
    observation: Observation,
    shape: tuple[int, int],
    python: Path | None = None,
    weights: Path | None = None,
) -> Acting:
    """Return the policy of a file: an ONNX model (`.onnx`), or the class `Policy` of a Python file (`.py`).

    Args:
        file: the model or the Python file.
        observation: what the policy perceives.
        shape: of the map, rows and columns.
        python: an interpreter that runs the Python file instead of this one.
        weights: external data of the model, or a file that the class reads.

    Raises:
        InputError: the file is missing, too large, of another kind, or does not fit the observation.
    """
    fields = observation.fields(shape)
    content = read_bytes(file)
    if file.suffix == ".onnx":
        return OnnxModel(file, content, fields, weights)
    if file.suffix == ".py":
        return PythonClass(file, content, weights) if python is None else PythonProcess(file, python, weights)
    raise InputError("is neither an ONNX model (.onnx) nor a Python file (.py)", file=file)
