"""Policies as ONNX models, which onnxruntime runs on one thread of the CPU."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.api import Float, InputError
from mrpbench_policies.acting.acting import Acting, Arrays, check_choice
from mrpbench_policies.observations import Field

NEXT = "next_"
"""Before the name of an input: the output that becomes this input in the next step."""
FOLDER = "session.model_external_initializers_file_folder_path"
"""The option of onnxruntime that says where external data is."""
TYPES = {
    "tensor(float)": "f4",
    "tensor(double)": "f8",
    "tensor(float16)": "f2",
    "tensor(int64)": "i8",
    "tensor(int32)": "i4",
    "tensor(int16)": "i2",
    "tensor(int8)": "i1",
    "tensor(uint8)": "u1",
    "tensor(bool)": "?",
}


class OnnxModel(Acting):
    """A model whose inputs are the arrays of an observation, by name; a single one may have any name.

    The first axis of all inputs and outputs is that of the robots, of any number. Further inputs are the memory of a
    recurrent model: each has an output with the same name after `next_`, and is 0 at first. The first other output are
    the scores or actions.

    Args:
        file: for messages.
        content: of the file.
        fields: of the observation.
        weights: the file of the initializers that the model does not contain (external data).

    Raises:
        InputError: onnxruntime is missing, it does not load the model, or the model does not fit.
    """

    def __init__(self, file: Path, content: bytes, fields: Mapping[str, Field], weights: Path | None = None) -> None:
        self._file, self._session = file, _session(file, content, weights)
        outputs = [output.name for output in self._session.get_outputs()]
        inputs = {node.name: node for node in self._session.get_inputs()}
        self._memory_of = {name: NEXT + name for name in inputs if NEXT + name in outputs}
        others = [name for name in inputs if name not in self._memory_of]
        self._field_of = {name: name for name in others}
        if len(others) == len(fields) == 1:
            self._field_of = {others[0]: next(iter(fields))}
        for name, field in self._field_of.items():
            if field not in fields:
                known = ", ".join(fields)
                hint = f"recurrent models have an output {NEXT + name!r}"
                raise InputError(f"has the input {name!r}; the observation has {known}", file=file, hint=hint)
            self._check(inputs[name], fields[field].shape)
        self._empty = {name: self._zero(inputs[name]) for name in self._memory_of}
        self._types = {name: self._type(node) for name, node in inputs.items()}
        choices = [name for name in outputs if name not in self._memory_of.values()]
        if not choices:
            raise InputError("has no output with scores or actions", file=file)
        self._outputs = [choices[0], *self._memory_of.values()]
        self._robots = 0

    def begin(self, robots: int, seed: int) -> None:  # noqa: ARG002 - models draw nothing
        """Set the memory to 0."""
        self._robots = robots
        self.memory = {name: np.zeros((robots, *zero.shape), zero.dtype) for name, zero in self._empty.items()}

    def act(self, observations: Arrays) -> Float:
        """Run the model."""
        inputs = {
            name: np.ascontiguousarray(observations[field], self._types[name]) for name, field in self._field_of.items()
        }
        try:
            choice, *memory = self._session.run(self._outputs, inputs | self.memory)
        except Exception as error:  # noqa: BLE001 - onnxruntime has many
            raise InputError(f"onnxruntime fails: {_line(error)}", file=self._file) from None
        for name, array in zip(self._memory_of, memory, strict=True):
            wanted = self.memory[name]
            if array.shape != wanted.shape or array.dtype != wanted.dtype:
                message = f"returned {NEXT + name} {array.dtype} {list(array.shape)}"
                raise InputError(f"{message}, not {wanted.dtype} {list(wanted.shape)}", file=self._file)
        self.memory = dict(zip(self._memory_of, memory, strict=True))
        return check_choice(choice, self._robots, self._file)

    def _type(self, node: Any) -> str:
        if node.type not in TYPES:
            raise InputError(f"has the input {node.name!r} of {node.type}, not of numbers", file=self._file)
        return TYPES[node.type]

    def _check(self, node: Any, shape: tuple[int, ...]) -> None:
        """Require that an input takes any number of arrays of a shape."""
        self._require_batch(node)
        own = node.shape[1:]
        fits = len(own) == len(shape)
        fits = fits and all(length == want for length, want in zip(own, shape, strict=True) if isinstance(length, int))
        if not fits:
            message = f"has the input {node.name!r} {_shape(own)}; the observation is {_shape(shape)} for each robot"
            raise InputError(message, file=self._file, hint="see the options `observation` and `radius`")

    def _require_batch(self, node: Any) -> None:
        if not node.shape or isinstance(node.shape[0], int):
            message = f"has the input {node.name!r} {_shape(node.shape)}, whose first axis has a fixed length"
            raise InputError(message, file=self._file, hint="the first axis of each input is that of the robots")

    def _zero(self, node: Any) -> np.ndarray:
        self._require_batch(node)
        if not all(isinstance(length, int) for length in node.shape[1:]):
            message = f"has the memory {node.name!r} {_shape(node.shape)}; only its first axis may be dynamic"
            raise InputError(message, file=self._file)
        return np.zeros(node.shape[1:], self._type(node))


def _session(file: Path, content: bytes, weights: Path | None) -> Any:
    try:
        import onnxruntime
    except ImportError:
        install = "`pip install 'mrpbench-policies[onnx]'`"
        raise InputError("is an ONNX model, and onnxruntime is not installed", file=file, hint=install) from None
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.use_deterministic_compute = True
    options.log_severity_level = 4  # faults are raised
    if weights is not None:
        if not weights.is_file():
            raise InputError("no such file", file=weights)
        if weights.name.encode() not in content:
            raise InputError(f"does not refer to {weights.name}, the file of the option `weights`", file=file)
        options.add_session_config_entry(FOLDER, str(weights.parent.resolve()))
    try:
        return onnxruntime.InferenceSession(content, options, providers=["CPUExecutionProvider"])
    except Exception as error:  # noqa: BLE001 - onnxruntime has many
        apart = weights is None and ("External data" in str(error) or "model_path" in str(error))
        hint = "its weights are in another file: name that by the option `weights`" if apart else None
        message = f"is not an ONNX model that onnxruntime runs: {_line(error)}"
        raise InputError(message, file=file, hint=hint) from None


def _line(error: Exception) -> str:
    """Return the text of an error of onnxruntime without its code and the signature of a function of it."""
    text = " ".join(str(error).split())
    text = re.sub(r"^\[ONNXRuntimeError\] : \d+ : \w+ : ", "", text)
    return re.sub(r"/onnxruntime_src/\S+:\d+ .*?\) (?=[A-Z!])", "", text)[:300]


def _shape(shape: Any) -> str:
    return "[" + ", ".join(map(str, shape)) + "]"
