"""Tasks that arrive at the times of a file."""

import math
from pathlib import Path

import attrs

from mrpbench_core.api.component import option
from mrpbench_core.api.task_source import TaskStream
from mrpbench_core.builtin.task_sources.drawn import AnyPlace, Drawing
from mrpbench_core.builtin.task_sources.listed import ListedStream
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import read_text
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.model.worlds.world import World


@attrs.frozen(kw_only=True)
class Trace(AnyPlace):
    """Tasks arrive at the times of a file, e.g. those of a day's orders. Their errands are drawn at random places."""

    file: Path = option(help="arrivals, one time in seconds a line, in order; `#` begins a comment")
    scale: float = option(1.0, help="factor on all times; 0.5 doubles the rate", validator=attrs.validators.gt(0))

    def start(self, world: World, roadmap: Roadmap, fleet: Fleet, seed: int) -> TaskStream:  # noqa: ARG002
        """Begin the stream of `seed`."""
        drawing = Drawing(self, self.places(world, roadmap), seed)
        return ListedStream([drawing.task(i, self.scale * at) for i, at in enumerate(read_arrivals(self.file))])


def read_arrivals(file: Path) -> list[float]:
    """Return the times of a file, in seconds.

    Raises:
        InputError: a line holds no time, or an earlier one than the line before.
    """
    times = [0.0]
    for line, text in enumerate(read_text(file).splitlines(), 1):
        word = text.partition("#")[0].strip()
        if not word:
            continue
        try:
            time = float(word)
        except ValueError:
            time = math.nan
        if not 0 <= time < math.inf:
            raise InputError(f"{word!r} is not a time in seconds from 0", file=file, line=line)
        if time < times[-1]:
            raise InputError(f"{word} s comes after {times[-1]:g} s", file=file, line=line, hint="sort the times")
        times.append(time)
    if len(times) == 1:
        raise InputError("has no times", file=file)
    return times[1:]
