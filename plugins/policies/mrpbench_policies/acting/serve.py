"""Runs the class `Policy` of a Python file for another process: `python serve.py FILE [WEIGHTS]`.

The interpreter may be that of another environment, which has NumPy and what the policy needs, but not mrpbench.
Requests and answers are pickles of plain values, so that versions of NumPy do not matter. An answer is an error, the
line of the file at which it was raised, and the value.
"""

import os
import pickle
import sys
import traceback
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np


def plain(arrays: Mapping[str, Any]) -> dict[str, Any]:
    """Return arrays by name as (dtype, shape, bytes)."""
    return {name: (array.dtype.str, array.shape, array.tobytes()) for name, array in arrays.items()}


def arrays_of(plain_arrays: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arrays by name for what `plain` returned; they can be written."""
    return {name: np.frombuffer(data, kind).reshape(shape).copy() for name, (kind, shape, data) in plain_arrays.items()}


def run_file(content: bytes, file: str, name: str) -> ModuleType:
    """Return the module of that name that a Python file makes."""
    module = ModuleType(name)
    module.__file__ = file
    sys.modules[name] = module  # dataclasses and pickle find classes there
    exec(compile(content, file, "exec"), vars(module))  # noqa: S102 - the user names the file to run it
    return module


def policy_of(module: ModuleType) -> Any:
    """Return the class `Policy` of a module, None if it has none with a method `act`."""
    made = getattr(module, "Policy", None)
    return made if isinstance(made, type) and callable(getattr(made, "act", None)) else None


class Server:
    """The policy of a file, and what it answers."""

    def __init__(self, file: str, weights: list[str]) -> None:
        self._weights = weights
        self._class = policy_of(run_file(Path(file).read_bytes(), file, "policy"))
        self._policy: Any = None

    def is_policy(self) -> bool:
        """Tell whether the file has a class `Policy` with a method `act`."""
        return self._class is not None

    def begin(self, robots: int, seed: int) -> Any:
        """Make a new policy; return its memory."""
        self._policy = self._class(robots, seed, *self._weights)
        return plain(getattr(self._policy, "memory", {}))

    def act(self, observations: Any, memory: Any) -> Any:
        """Return what the policy answers, and its memory after that."""
        if hasattr(self._policy, "memory"):
            self._policy.memory = arrays_of(memory)
        answer = np.asarray(self._policy.act(arrays_of(observations)))
        return plain({"answer": answer})["answer"], plain(getattr(self._policy, "memory", {}))


def main() -> None:
    """Answer requests until there are none."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what the policy prints is not an answer
    file, *weights = sys.argv[1:]
    server: Any = None
    while True:
        error, line, value = "", None, None
        try:
            if server is None:
                server = Server(file, weights)
                value = server.is_policy()
            else:
                name, *arguments = pickle.load(sys.stdin.buffer)  # noqa: S301 - from the process that started this one
                value = getattr(server, name)(*arguments)
        except EOFError:
            return
        except Exception as raised:  # noqa: BLE001 - policies raise anything
            error = " ".join(f"{type(raised).__name__}: {raised}".split())
            lines = [frame.lineno for frame in traceback.extract_tb(raised.__traceback__) if frame.filename == file]
            line = lines[-1] if lines else None
        pickle.dump((error, line, value), answers)
        answers.flush()


if __name__ == "__main__":
    main()
