"""Runs the class `Policy` of a Python file for another process: `python serve.py FILE`.

The interpreter may be that of another environment, which has NumPy and what the policy needs, but not mrpbench.
Requests and answers are pickles of plain values, arrays as (dtype, shape, bytes), so that versions of NumPy do not
matter.
"""

import pickle
import sys
from pathlib import Path
from typing import Any

import numpy as np


def main() -> None:
    """Answer requests until there are none."""
    answers, sys.stdout = sys.stdout.buffer, sys.stderr  # what the policy prints is not an answer
    file = sys.argv[1]
    content = Path(file).read_bytes()
    names: dict[str, Any] = {"__name__": "policy", "__file__": file}
    exec(compile(content, file, "exec"), names)  # noqa: S102 - the user names the file to run it
    made: Any = names.get("Policy")
    policy: Any = None
    sound = isinstance(made, type) and callable(getattr(made, "act", None))
    pickle.dump(sound, answers)
    answers.flush()
    while sound:
        try:
            request = pickle.load(sys.stdin.buffer)  # noqa: S301 - from the process that started this one
        except EOFError:
            return
        if request[0] == "begin":
            policy = made(*request[1:])
            answer = None
        else:
            observations = {
                name: np.frombuffer(data, kind).reshape(shape) for name, (kind, shape, data) in request[1].items()
            }
            array = np.asarray(policy.act(observations))
            answer = (array.dtype.str, array.shape, array.tobytes())
        pickle.dump(answer, answers)
        answers.flush()


if __name__ == "__main__":
    main()
