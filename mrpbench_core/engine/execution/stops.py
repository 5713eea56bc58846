"""The stops of robots by the model of the League of Robot Runners 2026, in ticks.

The stops of a robot depend neither on what it does nor, with `bernoulli`, on other robots; with `poisson` one stream
draws for the whole fleet, tick by tick.
"""

import math
from collections import deque
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.seeds import streams

Stop = tuple[int, int]
"""A robot stops from the beginning of the first tick to the beginning of the second one."""
NEVER = 2**62
"""A tick that no execution has; no stop begins later."""


def stops(settings: Delays, robots: int, seed: int, repeat: int, draws: Sequence[int]) -> list[Iterator[Stop]]:
    """The stops of each robot, in order and without end, of one draw after another.

    Args:
        settings: with `p_delay` above 0.
        robots: their number.
        seed: of the run.
        repeat: of the run.
        draws: numbers of the draws, ascending.
    """
    if settings.event_model == "poisson":
        fleets = [_PoissonStops(settings, robots, own) for own in streams(seed, repeat, "delays.poisson", 1, draws)]
        return [fleet.of(robot) for fleet in fleets for robot in range(robots)]
    return [_bernoulli(settings, own) for own in streams(seed, repeat, "delays.bernoulli", robots, draws)]


def _bernoulli(settings: Delays, random: np.random.Generator) -> Iterator[Stop]:
    """A robot that does not stop begins to in each tick with probability p, so the ticks until then are geometric."""
    length, geometric, p_delay, end = _length(settings, random), random.geometric, settings.p_delay, 0
    while True:
        begin = min(end + int(geometric(p_delay)) - 1, NEVER)
        end = begin + length()
        yield begin, end


class _PoissonStops:
    """In each tick, K ~ Poisson(n p) of the robots that do not stop begin to, or all of them if they are fewer."""

    def __init__(self, settings: Delays, robots: int, random: np.random.Generator) -> None:
        self._mean, self._random = robots * settings.p_delay, random
        self._length = _length(settings, random)
        self._end = np.zeros(robots, np.int64)
        self._found: list[deque[Stop]] = [deque() for _ in range(robots)]
        self._tick = -1

    def of(self, robot: int) -> Iterator[Stop]:
        found = self._found[robot]
        while True:
            while not found:
                self._advance()
            yield found.popleft()

    def _advance(self) -> None:
        """Go to the next tick in which K > 0. Given that, K is 1 + Poisson(mean - t), t the first event's time."""
        random, mean = self._random, self._mean
        some = -math.expm1(-mean)
        self._tick += int(random.geometric(some))
        first = -math.log1p(-random.random() * some)
        count = 1 + int(random.poisson(max(mean - first, 0.0)))
        free = np.flatnonzero(self._end <= self._tick)
        for robot in random.choice(free, min(count, len(free)), replace=False).tolist() if len(free) else ():
            self._end[robot] = self._tick + self._length()
            self._found[robot].append((self._tick, int(self._end[robot])))


def _length(settings: Delays, random: np.random.Generator) -> Callable[[], int]:
    """Draws the length of a stop in ticks."""
    least, most = settings.min_delay, settings.max_delay
    if settings.duration_model == "uniform":
        return lambda: int(random.integers(least, most + 1))
    mean, deviation = least + (most - least) * settings.gauss_mean_ratio, (most - least) * settings.gauss_std_ratio
    return lambda: min(max(round(random.normal(mean, deviation)), least), most)
