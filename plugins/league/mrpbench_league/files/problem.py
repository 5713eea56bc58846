"""Problems of the League of Robot Runners 2023, 2024 and 2026: a JSON file that names a map, agents and tasks."""

from pathlib import Path
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.movingai import read_movingai_map
from mrpbench_core.files.text import read_text
from mrpbench_core.model.common.arrays import Bool, Int32, array
from mrpbench_league.files.json_object import JsonObject

SEASONS = {"2023 LoRR": 2023, "2023": 2023, "2024 LoRR": 2024, "2026 LoRR": 2026}
Strategy = Literal["roundrobin", "roundrobin-fixed", "greedy"]
STRATEGIES = ("roundrobin", "roundrobin-fixed", "greedy")
LARGEST_POOL = 10**6


@attrs.frozen(kw_only=True)
class Delays:
    """When robots stop by chance: the delay model of 2026. Times are ticks."""

    seed: int = 0
    least: int
    most: int
    events: Literal["bernoulli", "poisson"]
    probability: float
    """Per robot and tick."""
    durations: Literal["uniform", "gaussian"]
    mean_ratio: float = 0.5
    """Mean of a Gaussian duration, as a share of the way from `least` to `most`."""
    deviation_ratio: float = 0.22
    """Standard deviation of a Gaussian duration, as a share of `most` - `least`."""


@attrs.frozen(kw_only=True)
class LorrProblem:
    """One problem. Cells count row by row from the top left: cell = row * width + column."""

    season: Literal[2023, 2024, 2026]
    blocked: Bool = array("bool")
    """bool[height,width], row 0 on top."""
    start: Int32 = array("i4")
    """i4[n]: the cell of each robot, which heads east."""
    errands: Int32 = array("i4")
    """i4[k]: the cells of all tasks, one task after another."""
    first: Int32 = array("i4")
    """i4[m+1]: the errands of task i are `errands[first[i]:first[i + 1]]`. After the last task the first follows."""
    reveal: float
    """2023: goals that each robot sees. Later: unfinished tasks that are visible, as a multiple of the robots."""
    strategy: Strategy = "roundrobin"
    """2023: how goals are given to robots."""
    counter: int = 1
    """Ticks of a move or turn; 1 where time is counted in steps."""
    size: float = 1.0
    """Side of a robot's square, in cells."""
    delays: Delays | None = None

    @property
    def pool(self) -> int:
        """Unfinished tasks that are visible at a time (2024, 2026)."""
        return int(self.reveal * len(self.start))


def read_problem(file: Path) -> LorrProblem:
    """Read a problem and the files that it names.

    Raises:
        InputError: a file is missing or malformed, or a cell is blocked; with file and line.
    """
    head = JsonObject.read(file)
    season = SEASONS[head.word("version", tuple(SEASONS), default="2023 LoRR")]
    blocked = read_movingai_map(file.parent / head.word("mapFile"))
    robots = head.whole("teamSize", 1, blocked.size)
    agents, tasks = (file.parent / head.word(key) for key in ("agentFile", "taskFile"))
    starts = _read_cells(agents, blocked, single=True)
    if len(starts) < robots:
        raise InputError(f"has {len(starts)} agents, teamSize is {robots}", file=agents)
    errands = _read_cells(tasks, blocked, single=season == 2023)
    _require_distinct(agents, starts[:robots])
    problem = LorrProblem(
        season=season,  # type: ignore[arg-type]
        blocked=blocked,
        start=np.array([cells[0] for _, cells in starts[:robots]], np.int32),
        errands=np.array([cell for _, cells in errands for cell in cells], np.int32),
        first=np.cumsum([0, *(len(cells) for _, cells in errands)]).astype(np.int32),
        reveal=head.number("numTasksReveal", 0 if season > 2023 else 1, LARGEST_POOL, default=1),
        strategy=head.word("taskAssignmentStrategy", STRATEGIES, default="roundrobin"),  # type: ignore[arg-type]
        counter=head.whole("agentCounter", 1, 1000, default=10) if season == 2026 else 1,
        size=head.number("agentSize", 0.01, 1, default=1.0) if season == 2026 else 1.0,
        delays=_delays(head) if season == 2026 else None,
    )
    if season == 2023 and problem.reveal % 1:
        raise head.error("numTasksReveal", f"should be a whole number of goals in 2023, is {problem.reveal:g}")
    if season > 2023 and not 1 <= problem.pool <= LARGEST_POOL:
        raise head.error("numTasksReveal", f"shows {problem.pool} tasks to {robots} robots; at least 1 is needed")
    return problem


def problem_reads(file: Path) -> tuple[Path, ...]:
    """Return the files that a problem names, as far as it can be read."""
    try:
        values = JsonObject.read(file).values
    except InputError:
        return ()
    names = (values.get(key) for key in ("mapFile", "agentFile", "taskFile"))
    return tuple(file.parent / name for name in names if isinstance(name, str))


def _delays(head: JsonObject) -> Delays | None:
    if "delayConfig" not in head.values:
        return None
    part = head.part("delayConfig")
    least = part.whole("minDelay", 0)
    return Delays(
        seed=part.whole("seed", 0, default=0),
        least=least,
        most=part.whole("maxDelay", least),
        events=part.word("eventModel", ("bernoulli", "poisson")),  # type: ignore[arg-type]
        probability=part.number("pDelay", 0, 1),
        durations=part.word("durationModel", ("uniform", "gaussian")),  # type: ignore[arg-type]
        mean_ratio=part.number("gaussMeanRatio", 0, 1, default=0.5),
        deviation_ratio=part.number("gaussStdRatio", 0, 10, default=0.22),
    )


def _read_cells(file: Path, blocked: Bool, *, single: bool) -> list[tuple[int, list[int]]]:
    """The number of each line and its cells. The first line says how many lines follow; `#` begins a comment."""
    lines = [(number, line.strip()) for number, line in enumerate(read_text(file).splitlines(), 1)]
    lines = [(number, line) for number, line in lines if line and not line.startswith("#")]
    if not lines or not _is_whole(lines[0][1]) or int(lines[0][1]) < 1:
        raise InputError("should begin with the number of lines", file=file, line=lines[0][0] if lines else 1)
    count = int(lines[0][1])
    if len(lines) <= count:
        raise InputError(f"has {len(lines) - 1} of {count} lines", file=file)
    free = ~blocked.ravel()
    lists = []
    for number, line in lines[1 : count + 1]:
        words = [word.strip() for word in line.rstrip(",").split(",")]
        if single and len(words) > 1:
            raise InputError("should hold one cell", file=file, line=number)
        for word in words:
            if not _is_whole(word):
                raise InputError(f"{word!r} is not a cell", file=file, line=number)
            if int(word) >= free.size:
                raise InputError(f"cell {word} is outside the map of {free.size} cells", file=file, line=number)
            if not free[int(word)]:
                raise InputError(f"cell {word} is blocked", file=file, line=number)
        lists.append((number, [int(word) for word in words]))
    return lists


def _require_distinct(file: Path, starts: list[tuple[int, list[int]]]) -> None:
    line_of: dict[int, int] = {}
    for number, (cell,) in starts:
        if cell in line_of:
            raise InputError(f"cell {cell} is the start of line {line_of[cell]} too", file=file, line=number)
        line_of[cell] = number


def _is_whole(word: str) -> bool:
    return word.isdecimal() and word.isascii() and len(word) < 10
