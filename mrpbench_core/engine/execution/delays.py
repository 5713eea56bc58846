"""Delays of robots: stops as in the League of Robot Runners 2026 or of an adversary, and speeds of segments of a path.

Every draw comes from the stream of its own cause and robot. The stops of one robot depend neither on what it does nor,
with `bernoulli`, on other robots; with `poisson` one stream draws for the whole fleet, tick by tick.
"""

import math
from collections import deque
from collections.abc import Callable, Iterator

import numpy as np

from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import stream
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.execution.motion import Event

Stop = tuple[int, int]
"""A robot stops from the beginning of the first tick to the beginning of the second one."""
_NEVER = (2**62, 2**62)


class DelayStream:
    """The delays of one run, or of one of its `Delays.draws`."""

    def __init__(
        self, settings: Delays, robots: int, seed: int, repeat: int, adversary: Adversary | None = None, draw: int = 0
    ) -> None:
        self.settings, self._adversary = settings, adversary
        self._speeds = (
            [stream(seed, repeat, "delays.speed", robot, draw) for robot in range(robots)] if settings.speed else []
        )
        self._factor: Float = np.ones((robots, 0))
        self._stops = _stops(settings, robots, seed, repeat, draw)
        self._stop: list[Stop] = [next(own) for own in self._stops]
        """The stop of each robot that is under way or comes next."""
        self._next = min((begin for begin, _ in self._stop), default=_NEVER[0])
        """The tick in which the next of them begins."""
        self._until = np.full(robots, -1)
        self._tick = -1

    def __bool__(self) -> bool:
        return bool(self.settings)

    def stops(self, robot: int) -> Iterator[tuple[float, float]]:
        """The stops of a robot in simulated seconds, in order, without end; use this or `begun`, not both."""
        tick = self.settings.tick
        yield self._stop[robot][0] * tick, self._stop[robot][1] * tick
        for begin, end in self._stops[robot]:
            yield begin * tick, end * tick

    def begun(self, now: float) -> tuple[Event, ...]:
        """The stops that began since the last call, as events; calls have increasing times."""
        tick = math.floor(now / self.settings.tick + 1e-9)
        events: list[Event] = []
        if not self.settings.p_delay or tick == self._tick:
            return ()
        while self._next <= tick:
            at = self._next
            for robot, (begin, end) in enumerate(self._stop):
                if begin == at:
                    self._until[robot] = end
                    self._stop[robot] = next(self._stops[robot])
                    detail = f"{(end - begin) * self.settings.tick:g} s"
                    events.append(Event(stamp=at * self.settings.tick, kind="delay", robot=robot, detail=detail))
            self._next = min(begin for begin, _ in self._stop)
        self._tick = tick
        return tuple(events)

    def attacked(self, now: float, reached: Int | Int32, released: Int | Int32) -> tuple[Event, ...]:
        """The stop that the adversary begins now, if any; see `Adversary.update`."""
        return self._adversary.update(now, reached, released) if self._adversary else ()

    @property
    def stopped(self) -> Bool:
        """The robots bool[n] that stop at the time of the last calls of `begun` and `attacked`."""
        stopped: Bool = self._until > self._tick
        return stopped | self._adversary.stopped if self._adversary else stopped

    def speed(self, segment: Int | Int32) -> Float:
        """Relative speed f8[n] of each robot on the `segment` i[n] of its path."""
        if not self._speeds:
            return np.ones(len(segment))
        if (missing := int(segment.max(initial=0)) + 1 - self._factor.shape[1]) > 0:
            sigma, missing = self.settings.speed, max(missing, 64)
            normal = np.reshape([own.standard_normal(missing) for own in self._speeds], (len(segment), missing))
            self._factor = np.hstack([self._factor, np.exp(sigma * normal - sigma**2 / 2)])
        factor: Float = self._factor[np.arange(len(segment)), segment]
        return factor

    def driven(self, twist: Float, segment: Int | Int32) -> Float:
        """The commands f8[n,2] that robots execute instead of `twist` f8[n,2] on the `segment` i[n] of their paths."""
        if not self:
            return twist
        return twist * np.where(self.stopped, 0.0, self.speed(segment))[:, None]


def _stops(settings: Delays, robots: int, seed: int, repeat: int, draw: int) -> list[Iterator[Stop]]:
    """The stops of each robot, without end."""
    if not settings.p_delay:
        return [iter(lambda: _NEVER, None) for _ in range(robots)]
    if settings.event_model == "poisson":
        fleet = _PoissonStops(settings, robots, stream(seed, repeat, "delays.poisson", draw=draw))
        return [fleet.of(robot) for robot in range(robots)]
    return [_bernoulli(settings, stream(seed, repeat, "delays.bernoulli", robot, draw)) for robot in range(robots)]


def _bernoulli(settings: Delays, random: np.random.Generator) -> Iterator[Stop]:
    """A robot that does not stop begins to in each tick with probability p, so the ticks until then are geometric."""
    length, end = _length(settings, random), 0
    while True:
        begin = end + int(random.geometric(settings.p_delay)) - 1
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
