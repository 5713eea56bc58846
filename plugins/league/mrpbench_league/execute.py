"""Executes a problem of the League of Robot Runners (2023, 2024, 2026) and writes the output of that season."""

from pathlib import Path
from typing import Any, Literal

import attrs
import numpy as np
from mrpbench_native import discrete

from mrpbench_core.model.common.arrays import Byte, Int32
from mrpbench_league.files.motion import Motion, write_segments, write_steps
from mrpbench_league.files.output import LorrOutput, write_output
from mrpbench_league.files.problem import LorrProblem

DEEP = 3000
"""Robots up to which operations have five actions by default."""
SEGMENT = 100
"""Ticks of a segment of motion (2026)."""


@attrs.frozen(kw_only=True)
class Options:
    """Who plans, and what an answer may cost."""

    planner: Literal["pibt", "epibt"] = "epibt"
    depth: int | None = attrs.field(default=None, validator=attrs.validators.in_((None, 3, 4, 5)))
    """Actions of an operation of `epibt`. None: 5 up to 3,000 robots, else 4, since a round takes
    a third of the time then."""
    improve: bool = True
    """Large neighbourhood search of `epibt`, as long as there is time."""
    threads: int = attrs.field(default=1, validator=attrs.validators.ge(1))
    """Of this search. Results do not depend on their number if `iterations` is given."""
    guidance: bool = True
    """Whether moves cost more where there is traffic."""
    active: int | None = attrs.field(default=None, validator=attrs.validators.optional(attrs.validators.ge(1)))
    """Robots that have a goal at the same time, at most; None: half as many as there are free cells, in
    2023 three eighths. Those without a goal give way."""
    limit: float = attrs.field(default=1.0, validator=attrs.validators.gt(0))
    """Seconds of one answer. A later one costs steps in which all robots wait (2023, 2024), or comes into effect later
    (2026)."""
    iterations: int | None = None
    """Rounds of improvement instead of seconds: the clock is not read, so that equal runs have equal outputs."""
    period: int = attrs.field(default=10, validator=attrs.validators.ge(1))
    """Ticks of 100 ms between two calls of the planner (2026)."""
    seed: int = attrs.field(default=0, validator=attrs.validators.ge(0))
    preprocessing: float = attrs.field(default=30.0, validator=attrs.validators.ge(0))
    """Seconds before the first step in which distance tables are computed, as in the competition. With `iterations`
    there is no such phase, since the clock is not read: tables are computed when they are asked for."""
    table_mib: int = attrs.field(default=2048, validator=attrs.validators.ge(1))
    """Memory for distance tables, MiB. The least recently used ones are dropped and computed again when they are asked
    for; the motion does not depend on it, but for the clock."""

    def arguments(self, robots: int) -> dict[str, Any]:
        """The arguments of `discrete.open` for so many robots."""
        depth = self.depth or (5 if robots <= DEEP else 4)
        return attrs.asdict(attrs.evolve(self, depth=depth))


@attrs.frozen(kw_only=True)
class Executed:
    """What happened."""

    output: LorrOutput
    paths: list[str]
    """The motion of each robot as the output has it."""
    errands: int
    call_seconds: np.ndarray
    """f8[k] of each call of scheduler and planner."""
    late_calls: int
    preprocessing_seconds: float
    """Of the phase before the first call, which counts as no call."""
    refused: int
    """Motions that were refused because a robot was in the way (2026)."""
    others: dict[str, Any]
    """Further keys of the output."""

    def write(self, file: Path) -> None:
        """Write the output."""
        write_output(file, self.output, self.paths, **self.others)


def execute(problem: LorrProblem, duration: int, options: Options | None = None) -> Executed:
    """Execute a problem for so many steps or ticks.

    Raises:
        ValueError: an option is out of range.
    """
    wanted = options or Options()
    running = discrete.open(problem=problem, **wanted.arguments(len(problem.start)))
    running.run_until(duration)
    letters = running.letters
    robots, width = len(problem.start), problem.blocked.shape[1]
    ticked = problem.season == 2026
    segments = running.segments
    unexecuted = running.unexecuted[np.argsort(running.unexecuted[:, 1], kind="stable")]
    paths, asked, motion = [], [], []
    for robot, rows in enumerate(np.split(unexecuted, np.searchsorted(unexecuted[:, 1], np.arange(1, robots)))):
        column = np.ascontiguousarray(letters[:, robot])
        planned = column.copy()
        planned[rows[:, 0]] = rows[:, 2]
        paths.append(_text(column, segments[:, robot], ticked))
        asked.append(_text(planned, segments[:, robot], ticked))
        motion.append(Motion(column, ((0, len(column)),) if ticked else ()))
    delays: list[list[tuple[int, int]]] = [[] for _ in range(robots)]
    for robot, start, end in running.delays.tolist():
        delays[robot].append((start, end))
    rows, columns = np.divmod(problem.start, width)
    output = LorrOutput(
        season=problem.season,
        start=np.stack([rows, columns, np.zeros_like(rows)], axis=1).astype(np.int32),
        makespan=duration,
        motion=tuple(motion),
        events=tuple((time, robot, task, done) for time, robot, task, done in running.events.tolist()),
        tasks=tuple(_task(problem, task, line, time) for task, (line, time, _, _) in enumerate(running.tasks.tolist())),
        schedule=tuple(running.schedule) if problem.season > 2023 else None,
        finished=running.finished,
        counter=problem.counter,
        delays=tuple(map(tuple, delays)) if ticked else None,
    )
    return Executed(
        output=output,
        paths=paths,
        errands=running.errands,
        call_seconds=running.call_seconds,
        late_calls=running.late_calls,
        preprocessing_seconds=running.preprocessing_seconds,
        refused=running.refused,
        others={"plannerPaths": asked} | _others(problem, running, duration),
    )


def _text(letters: Byte, states: Int32, ticked: bool) -> str:
    return write_segments(letters, states, SEGMENT) if ticked else write_steps(letters)


def _task(problem: LorrProblem, task: int, line: int, time: int) -> tuple[int, int, tuple[int, ...]]:
    cells = problem.errands[problem.first[line] : problem.first[line + 1]]
    places = np.stack(np.divmod(cells, problem.blocked.shape[1]), axis=1)
    return task, time if problem.season > 2023 else 0, tuple(places.ravel().tolist())


def _others(problem: LorrProblem, running: discrete.Execution, duration: int) -> dict[str, Any]:
    errors = [list(error) for error in running.errors]
    times = [round(seconds, 6) for seconds in running.call_seconds.tolist()]
    fields: dict[str, Any] = {"errors": errors, "plannerTimes": times}
    if problem.season == 2023:
        return fields | {"AllValid": "No" if errors else "Yes", "sumOfCost": duration * len(problem.start)}
    wrong = [list(error) for error in running.schedule_errors]
    fields |= {"numPlannerErrors": len(errors), "numScheduleErrors": len(wrong), "scheduleErrors": wrong}
    fields["numEntryTimeouts"] = running.late_calls
    return fields | ({"outputSegmentSize": SEGMENT} if problem.season == 2026 else {})
