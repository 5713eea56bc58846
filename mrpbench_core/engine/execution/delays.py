"""Delays of robots: stops as in the League of Robot Runners 2026 or of an adversary, and speeds of segments of a path.

Every draw comes from the stream of its own cause and robot.
"""

import copy
import math
from collections.abc import Iterator, Sequence

import numpy as np

from mrpbench_core.config.delays import Delays
from mrpbench_core.engine.execution.stops import NEVER, Stop, stops
from mrpbench_core.engine.execution.worst_case import Adversary
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.common.arrays import Bool, Float, Int, Int32
from mrpbench_core.model.execution.motion import Event

_AT_ONCE = 64
"""Segments whose speeds are drawn at once."""


class DrawnDelays:
    """What is drawn of the delays of `draws` executions: k robots, those of one execution after those of another."""

    def __init__(self, settings: Delays, robots: int, seeds: Seeds, draws: Sequence[int]) -> None:
        count = robots * len(draws)
        self.settings = settings
        self._speeds = seeds.streams("delays.speed", robots, draws) if settings.speed else []
        self._factor: Float = np.ones((count, 0))
        self._stops = stops(settings, robots, seeds, draws) if settings.p_delay else None
        self._begin: Int = np.full(count, NEVER)
        """The tick i8[k] in which each robot's next stop begins."""
        self._end: Int = np.full(count, NEVER)
        """The tick i8[k] in which that stop ends."""
        self._draw(np.arange(count))
        self._next = int(self._begin.min(initial=NEVER))
        self._until: Int = np.full(count, -1)
        self._tick = -1

    def stops(self, robot: int) -> Iterator[Stop]:
        """The stops of a robot, in order, without end; use this or `begun`, not both."""
        while self._stops is not None:
            yield int(self._begin[robot]), int(self._end[robot])
            self._draw(np.array([robot]))

    def begun(self, now: float) -> list[tuple[int, int, int]]:
        """The stops that began since the last call, as (tick, robot, tick of the end), sorted; times increase."""
        tick = math.floor(now / self.settings.tick + 1e-9)
        stops: list[tuple[int, int, int]] = []
        while self._next <= tick:
            robots = np.flatnonzero(self._begin <= tick)
            begin, end = self._begin[robots], self._end[robots]
            stops += zip(begin.tolist(), robots.tolist(), end.tolist(), strict=True)
            self._until[robots] = end
            self._draw(robots)
            self._next = int(self._begin.min())
        self._tick = tick
        return sorted(stops)

    def forget(self, robots: Int) -> None:
        """Draw no further stops of `robots` i8[j]."""
        self._begin[robots] = NEVER

    def _draw(self, robots: Int) -> None:
        """Draw the next stops of `robots` i8[j]."""
        if self._stops is not None:
            drawn = np.array(self._stops.following(robots.tolist()), np.int64).reshape(-1, 2)
            self._begin[robots], self._end[robots] = drawn.T

    @property
    def stopped(self) -> Bool:
        """The robots bool[k] that stop at the time of the last call of `begun`."""
        stopped: Bool = self._until > self._tick
        return stopped

    def speed(self, robot: Int, segment: Int | Int32) -> Float:
        """Relative speed f8[j] of each `robot` i8[j] on the `segment` i[j] of its path."""
        if not self._speeds:
            return np.ones(len(segment))
        if (missing := int(segment.max(initial=0)) + 1 - self._factor.shape[1]) > 0:
            sigma, missing = self.settings.speed, max(missing, _AT_ONCE)
            normal = np.reshape(
                [stream.standard_normal(missing) for stream in self._speeds], (len(self._speeds), missing)
            )
            self._factor = np.hstack([self._factor, np.exp(sigma * normal - sigma**2 / 2)])
        factor: Float = self._factor[robot, segment]
        return factor


class DelayStream:
    """The delays of one run, or of several draws of them; the same adversary attacks in each.

    Args:
        settings: of the delays.
        robots: n.
        seeds: of the run.
        draws: numbers of the d draws. Robot i of draw j is number j n + i.
        adversary: as it is before an execution; none by default.
    """

    def __init__(
        self,
        settings: Delays,
        robots: int,
        seeds: Seeds,
        draws: Sequence[int] = (0,),
        adversary: Adversary | None = None,
    ) -> None:
        self.settings, self.executions = settings, len(draws)
        self._adversaries = [copy.deepcopy(adversary) for _ in draws] if adversary else []
        self._drawn = DrawnDelays(settings, robots, seeds, draws)
        self._robots: Int = np.arange(robots)
        self.forget = self._drawn.forget
        self.speed = self._drawn.speed

    def __bool__(self) -> bool:
        return bool(self.settings)

    def stops(self, robot: int) -> Iterator[tuple[float, float]]:
        """The stops of a robot in simulated seconds, in order, without end; use this or `begun`, not both."""
        tick = self.settings.tick
        return ((begin * tick, end * tick) for begin, end in self._drawn.stops(robot))

    def begun(self, now: float) -> Iterator[Event]:
        """The stops that began since the last call, as events, each made when it is read; times increase."""
        tick = self.settings.tick
        return (
            Event(stamp=begin * tick, kind="delay", robot=robot, detail=f"{(end - begin) * tick:g} s")
            for begin, robot, end in self._drawn.begun(now)
        )

    def attacked(self, now: float, reached: Int | Int32, released: Int | Int32) -> tuple[Event, ...]:
        """The stops that adversaries begin now; see `Adversary.update`. The counts are i[dn]."""
        events: tuple[Event, ...] = ()
        for index, adversary in enumerate(self._adversaries):
            robots = slice(index * len(self._robots), (index + 1) * len(self._robots))
            events += adversary.update(now, reached[robots], released[robots])
        return events

    @property
    def stopped(self) -> Bool:
        """The robots bool[dn] that stop at the time of the last calls of `begun` and `attacked`."""
        stopped = self._drawn.stopped
        if not self._adversaries:
            return stopped
        attacked: Bool = np.concatenate([adversary.stopped for adversary in self._adversaries])
        return stopped | attacked

    def driven(self, twist: Float, segment: Int | Int32) -> Float:
        """The commands f8[n,2] that robots execute instead of `twist` f8[n,2] on the `segment` i[n] of their paths."""
        if not self:
            return twist
        return twist * np.where(self.stopped, 0.0, self.speed(self._robots, segment))[:, None]
