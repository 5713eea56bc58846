"""Runs a policy that is a Python class, in this process."""

from pathlib import Path
from typing import Any

from mrpbench_core.api import Float, InputError
from mrpbench_policies.acting.acting import Acting, Arrays, check_choice


class PythonClass(Acting):
    """The class `Policy` of a file: `act(observations)` returns scores or actions, see `check_choice`.

    It is made anew for each execution, with the number of robots and the seed. If it has an attribute `memory`, a
    mapping of arrays whose rows are robots, the planner sets it back where robots did not get as far as planned.

    Args:
        file: for messages.
        content: of the file.

    Raises:
        InputError: the file defines no such class.
    """

    def __init__(self, file: Path, content: bytes) -> None:
        self._file = file
        names: dict[str, Any] = {"__name__": file.stem, "__file__": str(file)}
        try:
            exec(compile(content, str(file), "exec"), names)  # noqa: S102 - the user names the file to run it
        except SyntaxError as error:
            raise InputError(f"is not Python: {error.msg}", file=file, line=error.lineno) from None
        made = names.get("Policy")
        if not isinstance(made, type) or not callable(getattr(made, "act", None)):
            raise InputError("defines no class `Policy` with a method `act`", file=file)
        self._class: Any = made
        self._robots = 0
        self._policy: Any = None

    def begin(self, robots: int, seed: int) -> None:
        """Make a new policy."""
        self._robots, self._policy = robots, self._class(robots, seed)

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
