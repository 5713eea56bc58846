"""Where episodes take place: maps, starts and goals, one for each seed."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from mrpbench_core.api import Bool, InputError, Instance, Int
from mrpbench_core.config.settings import RunConfig
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.prepare.make_instance import make_instance
from mrpbench_core.engine.prepare.question import Question
from mrpbench_core.engine.stage import ignore
from mrpbench_policies.board import board_of
from mrpbench_policies.maps import Maps


@attrs.frozen(kw_only=True, eq=False)
class Scene:
    """One episode."""

    blocked: Bool
    """bool[rows,columns]; row 0 is on top."""
    start: Int
    """i8[n,2] row and column of each robot."""
    goal: Int
    """i8[n,2]."""
    instance: Instance | None = None
    """The instance of a run that takes place there, for depths with bodies."""


class Scenes(ABC):
    """Draws scenes that have the same number of robots and maps of the same shape."""

    robots: int
    shape: tuple[int, int]

    @abstractmethod
    def draw(self, seed: int) -> Scene:
        """Return the scene of a seed."""


class RandomScenes(Scenes):
    """Maps with obstacles at random, robots and goals in the largest component.

    Args:
        robots: number of robots.
        rows: of the map.
        columns: of the map.
        density: probability that a cell is blocked.
    """

    def __init__(self, robots: int, rows: int = 32, columns: int = 32, density: float = 0.2) -> None:
        if not (0 <= density < 1 and rows >= 1 and columns >= 1 and robots >= 1):
            raise ValueError("`density` is at least 0 and below 1, and the other arguments are at least 1")
        self.robots, self.shape, self._density = robots, (rows, columns), density

    def draw(self, seed: int) -> Scene:
        """Return a map that has room for the robots.

        Raises:
            InputError: none of 100 has.
        """
        generator = np.random.default_rng(seed)
        for _ in range(100):
            blocked = generator.random(self.shape) < self._density
            maps = Maps(blocked[None], 1)
            left = maps.places(np.argwhere(~blocked)[None])[0]
            largest = left[:0]
            while len(left) > len(largest):
                component = maps.component(int(left[0]))
                largest = max(largest, component, key=len)
                left = np.setdiff1d(left, component, assume_unique=True)
            if len(largest) >= self.robots:
                cells = maps.cells(largest)
                start, goal = (generator.permutation(cells)[: self.robots] for _ in range(2))
                return Scene(blocked=blocked, start=start, goal=goal)
        message = f"a map of {self.shape[0]} x {self.shape[1]} cells has no room for {self.robots} robots"
        raise InputError(message, hint="fewer robots, or a lower density")


class StudyScenes(Scenes):
    """The instances of the first run of a study with other seeds, so that training and runs meet the same scenarios.

    Args:
        source: a study, as a file or as its content.
        overrides: `key=value`, as on the command line.

    Raises:
        InputError: the study is wrong, or its roadmap is not one of cells on which robots walk step by step.
    """

    def __init__(self, source: Path | str | dict[str, Any], overrides: Sequence[str] = ()) -> None:
        study = load_study(source, overrides)
        if study.errors:
            raise study.errors[0]
        self.config: RunConfig = study.runs[0].config
        first = self.draw(self.config.seed)
        self.robots, self.shape = len(first.start), (first.blocked.shape[0], first.blocked.shape[1])

    def draw(self, seed: int) -> Scene:
        """Return the instance of a seed."""
        instance = make_instance(Question.of(attrs.evolve(self.config, seed=seed)), ignore, {})
        board = board_of(instance.roadmap, 1)
        if isinstance(board, str):
            raise InputError(f"roadmap: the environment {board}")
        if not board.is_unit:
            message = "roadmap: the environment needs a roadmap without headings on which every move takes one tick"
            raise InputError(message, hint="`duration_model: constant`; robots turn in the depth `timed`")
        problem = instance.problem
        if any(len(goals) != 1 or len(goals[0]) != 1 for goals in problem.goals):
            raise InputError("scenario: in the environment every robot has one goal")
        maps = board.maps
        rows, columns = maps.shape
        blocked = maps.blocked.reshape(maps.height, maps.width)[1 : rows + 1, 1 : columns + 1]
        return Scene(
            blocked=blocked.copy(),
            start=maps.cells(board.place[problem.start]),
            goal=maps.cells(board.place[[goals[0][0] for goals in problem.goals]]),
            instance=instance,
        )
