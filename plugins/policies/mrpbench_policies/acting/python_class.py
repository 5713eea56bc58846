"""Runs a policy that is a Python class, in this process."""

import hashlib
from pathlib import Path
from typing import Any

from mrpbench_core.api import Float, InputError
from mrpbench_policies.acting.acting import Acting, Arrays, check_choice
from mrpbench_policies.acting.serve import policy_of, run_file


class PythonClass(Acting):
    """The class `Policy` of a file: `act(observations)` returns scores or actions, see `check_choice`.

    It is made anew for each plan, with the number of robots, the seed and the file `weights`, if there is one. If it
    has an attribute `memory`, a mapping of arrays whose rows are robots, the planner sets that to what the policy
    remembered where robots are now.

    Args:
        file: for messages.
        content: of the file.
        weights: a file that the class reads.

    Raises:
        InputError: the file defines no such class.
    """

    def __init__(self, file: Path, content: bytes, weights: Path | None = None) -> None:
        self._file, self._further = file, () if weights is None else (str(weights),)
        name = "mrpbench_policy_" + hashlib.sha256(content).hexdigest()[:24]
        try:
            made = policy_of(run_file(content, str(file), name))
        except SyntaxError as error:
            raise InputError(f"is not Python: {error.msg}", file=file, line=error.lineno) from None
        if made is None:
            raise InputError("defines no class `Policy` with a method `act`", file=file)
        self._class: Any = made
        self._robots = 0
        self._policy: Any = None

    def begin(self, robots: int, seed: int) -> None:
        """Make a new policy."""
        self._robots, self._policy = robots, self._class(robots, seed, *self._further)

    @property
    def memory(self) -> Any:
        """The attribute `memory` of the policy, empty without one."""
        return getattr(self._policy, "memory", {})

    @memory.setter
    def memory(self, memory: Any) -> None:
        if hasattr(self._policy, "memory"):
            self._policy.memory = memory

    def act(self, observations: Arrays) -> Float:
        """Ask the policy."""
        assert self._policy is not None, "`begin` was called"
        return check_choice(self._policy.act(observations), self._robots, self._file)
