"""The stops of robots by the model of the League of Robot Runners 2026, in ticks.

The stops of a robot depend neither on what it does nor, with `bernoulli`, on other robots; with `poisson` one stream
draws for the whole fleet, tick by tick. Robots are numbered through all draws, those of one after those of another.
"""

import math
from collections import deque
from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np

from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.seeds import Seeds

Stop = tuple[int, int]
"""A robot stops from the beginning of the first tick to the beginning of the second one."""
NEVER = 2**62
"""A tick that no execution has; no stop begins later."""


class Stops(Protocol):
    """The stops of each robot, in order and without end."""

    def following(self, robots: Sequence[int]) -> list[Stop]:
        """The stop of each of these `robots` that follows the one it was given before."""


def stops(settings: Delays, robots: int, seeds: Seeds, draws: Sequence[int]) -> Stops:
    """The stops of all robots.

    Args:
        settings: with `p_delay` above 0.
        robots: their number in one draw.
        seeds: of the run.
        draws: numbers of the draws, ascending.
    """
    if settings.event_model == "poisson":
        random_streams = seeds.streams("delays.poisson", 1, draws)
        return _PoissonStops([_Fleet(settings, robots, random) for random in random_streams], robots)
    return _BernoulliStops(settings, seeds.streams("delays.bernoulli", robots, draws))


class _BernoulliStops:
    """A robot that does not stop begins to in each tick with probability p, so the ticks until then are geometric."""

    def __init__(self, settings: Delays, streams: Sequence[np.random.Generator]) -> None:
        self._p_delay, self._length, self._streams = settings.p_delay, _length(settings), streams
        self._end = [0] * len(streams)

    def following(self, robots: Sequence[int]) -> list[Stop]:
        p_delay, length, streams, end = self._p_delay, self._length, self._streams, self._end
        stops = []
        for robot in robots:
            random = streams[robot]
            begin = min(end[robot] + int(random.geometric(p_delay)) - 1, NEVER)
            end[robot] = begin + length(random)
            stops.append((begin, end[robot]))
        return stops


class _PoissonStops:
    """Those of several fleets."""

    def __init__(self, fleets: Sequence["_Fleet"], robots: int) -> None:
        self._fleets, self._robots = fleets, robots

    def following(self, robots: Sequence[int]) -> list[Stop]:
        return [self._fleets[robot // self._robots].following(robot % self._robots) for robot in robots]


class _Fleet:
    """In each tick, K ~ Poisson(n p) of the robots that do not stop begin to, or all of them if they are fewer."""

    def __init__(self, settings: Delays, robots: int, random: np.random.Generator) -> None:
        self._mean, self._random = robots * settings.p_delay, random
        self._length = _length(settings)
        self._end = np.zeros(robots, np.int64)
        self._stops: list[deque[Stop]] = [deque() for _ in range(robots)]
        self._tick = -1

    def following(self, robot: int) -> Stop:
        stops = self._stops[robot]
        while not stops:
            self._advance()
        return stops.popleft()

    def _advance(self) -> None:
        """Go to the next tick in which K > 0. Given that, K is 1 + Poisson(mean - t), t the first event's time."""
        random, mean = self._random, self._mean
        some = -math.expm1(-mean)
        self._tick += int(random.geometric(some))
        first = -math.log1p(-random.random() * some)
        count = 1 + int(random.poisson(max(mean - first, 0.0)))
        free = np.flatnonzero(self._end <= self._tick)
        for robot in random.choice(free, min(count, len(free)), replace=False).tolist() if len(free) else ():
            self._end[robot] = self._tick + self._length(random)
            self._stops[robot].append((self._tick, int(self._end[robot])))


def _length(settings: Delays) -> Callable[[np.random.Generator], int]:
    """Draws the length of a stop in ticks."""
    least, most = settings.min_delay, settings.max_delay
    if settings.duration_model == "uniform":
        above = most + 1
        return lambda random: int(random.integers(least, above))
    mean, deviation = least + (most - least) * settings.gauss_mean_ratio, (most - least) * settings.gauss_std_ratio
    return lambda random: min(max(round(random.normal(mean, deviation)), least), most)
