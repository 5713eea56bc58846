"""Contract of policies while they act."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrpbench_core.api import Float, InputError
from mrpbench_policies.maps import ACTIONS

Arrays = Mapping[str, NDArray[Any]]
Memory = dict[str, NDArray[Any]]
"""What a recurrent policy remembers: arrays by name, whose rows are robots."""
CERTAIN = 1000.0
"""The score of an action that a policy returns: so much more than others that sampling never draws another one."""


class Acting(ABC):
    """A policy that acts for k robots, step by step."""

    memory: Memory
    """What it remembers since the last step; the planner may set it back to that of an earlier one."""

    @abstractmethod
    def begin(self, robots: int, seed: int) -> None:
        """Forget everything, before the first step of `robots` robots."""

    @abstractmethod
    def act(self, observations: Arrays) -> Float:
        """Return scores f8[k,5] of the actions of each robot, of which more is better.

        Raises:
            InputError: the policy fails, or what it returns are no scores or actions.
        """


def check_choice(answer: Any, robots: int, file: Path) -> Float:
    """Return scores f8[k,5] for what a policy returned: scores f8[k,5], or actions i8[k] from 0 to 4.

    Raises:
        InputError: it is neither.
    """
    choice = np.asarray(answer)
    wanted = f"scores [{robots}, {len(ACTIONS)}] or actions [{robots}]"
    if choice.dtype.kind not in "iuf":
        raise InputError(f"returned {choice.dtype}, not numbers: {wanted}", file=file)
    if choice.shape == (robots, len(ACTIONS)):
        scores = choice.astype(np.float64)
        if (wrong := np.isnan(scores).any(axis=1)).any():
            raise InputError(f"returned NaN as a score of robot_{int(wrong.argmax())}", file=file)
        return scores
    if choice.shape not in ((robots,), (robots, 1)):
        raise InputError(f"returned {choice.dtype} {list(choice.shape)}, not {wanted}", file=file)
    if choice.dtype.kind == "f":
        raise InputError(f"returned actions of {choice.dtype}, not of integers", file=file)
    actions = choice.reshape(robots)
    if (wrong := (actions < 0) | (actions >= len(ACTIONS))).any():
        robot = int(wrong.argmax())
        raise InputError(f"returned action {actions[robot]} for robot_{robot}, not 0 to {len(ACTIONS) - 1}", file=file)
    scores = np.zeros((robots, len(ACTIONS)))
    scores[:, 0] = CERTAIN / 2  # a robot that may not do what it wants rather stays
    scores[np.arange(robots), actions] = CERTAIN
    return scores
