"""Faults of robots and of the building: drawn before the execution, and active during it.

Every draw comes from the stream of its own entry and robot (or door, lift, building), so that faults depend on neither
the planner nor what happens during the execution.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

import attrs
import numpy as np

from mrpbench_core.config.faults import OF_ROBOTS, Fault, Faults
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool, Float, Int32
from mrpbench_core.model.common.geometry import point_segment_distance
from mrpbench_core.model.execution.motion import Event
from mrpbench_core.model.execution.observation import ScanBatch
from mrpbench_core.model.execution.orders import FleetView
from mrpbench_core.model.planning.roadmap import Roadmap

TOLERANCE = 1e-6


@attrs.frozen(kw_only=True)
class FaultEvent:
    """One fault of an execution."""

    kind: str
    """That of `Fault`."""
    begin: float
    end: float
    """simulated seconds; inf = for good."""
    robot: int = -1
    facility: str = ""
    place: tuple[float, float] = (math.nan, math.nan)
    level: int = 0
    radius: float = 0.0
    speed: float = 1.0

    @property
    def what(self) -> str:
        """What is wrong, without its subject, if that is a robot, and without times."""
        if self.kind == "slow":
            return f"has {self.speed:g} times its usual speed"
        if self.kind == "out_of_order":
            return f"{self.facility} is out of order"
        if self.kind == "blocked":
            return f"the floor at ({self.place[0]:.2f}, {self.place[1]:.2f}) is blocked"
        return {"stop": "stops", "lidar": "has no lidar", "silent": "is silent"}[self.kind]

    @property
    def detail(self) -> str:
        """What is wrong and for how long."""
        return f"{self.what} for good" if math.isinf(self.end) else f"{self.what} for {self.end - self.begin:.1f} s"


def draw_faults(
    settings: Faults, robots: int, roadmap: Roadmap, facilities: Sequence[str], limit_s: float, seeds: Seeds
) -> tuple[FaultEvent, ...]:
    """Return the faults that begin before `limit_s` simulated seconds, by time.

    Args:
        settings: what fails, and how often.
        robots: their number.
        roadmap: at whose vertices blocked places are drawn.
        facilities: names of the doors and lifts that can fail.
        limit_s: of the execution.
        seeds: of the run.

    Raises:
        InputError: an entry names a robot, door, lift or level that does not exist.
    """
    if not settings:
        return ()
    events: list[FaultEvent] = []
    for number, entry in enumerate(settings.events):
        count = robots if entry.kind in OF_ROBOTS else len(facilities) if entry.kind == "out_of_order" else 1
        where = f"faults.events.{number}"
        known = 1 + int(roadmap.level.max(initial=0))
        if entry.kind == "blocked" and entry.place is not None and entry.level >= known:
            raise InputError(f"{where}.level: must be below {known}, got {entry.level}")
        subject = _subject(entry, count, facilities, where)
        if subject is None and entry.at is not None and count:
            subject = int(seeds.stream(f"faults.{number}.subject").integers(count))
        for index in range(count) if subject is None else (subject,):
            random = seeds.stream(f"faults.{number}", index)
            for begin, end in _times(entry, limit_s, random):
                events.append(_event(entry, index, begin, end, facilities, roadmap, random))
    return tuple(sorted(events, key=lambda event: (event.begin, event.robot, event.facility)))


def _subject(entry: Fault, count: int, facilities: Sequence[str], where: str) -> int | None:
    """The index of what an entry names, None = nothing."""
    if entry.robot is not None and entry.robot >= count:
        raise InputError(f"{where}.robot: there is no robot {entry.robot}; the fleet has {count}")
    if entry.facility is None:
        return entry.robot
    if entry.facility not in facilities:
        hint = f"there are {', '.join(facilities)}" if facilities else "the plan uses neither doors nor lifts here"
        raise InputError(f"{where}.facility: there is no door or lift {entry.facility!r}", hint=hint)
    return facilities.index(entry.facility)


def _times(entry: Fault, limit_s: float, random: np.random.Generator) -> Iterator[tuple[float, float]]:
    """When faults of one subject begin and end."""
    if entry.at is not None:
        yield entry.at, entry.at + (math.inf if entry.lasts is None else entry.lasts)
        return
    assert entry.mtbf is not None
    end = 0.0
    while (begin := end + float(random.exponential(entry.mtbf))) < limit_s:
        end = math.inf if entry.lasts is None else begin + float(random.exponential(entry.lasts))
        yield begin, end


def _event(
    entry: Fault,
    index: int,
    begin: float,
    end: float,
    facilities: Sequence[str],
    roadmap: Roadmap,
    random: np.random.Generator,
) -> FaultEvent:
    event = FaultEvent(kind=entry.kind, begin=begin, end=end)
    if entry.kind in OF_ROBOTS:
        return attrs.evolve(event, robot=index, speed=entry.speed if entry.kind == "slow" else 1.0)
    if entry.kind == "out_of_order":
        return attrs.evolve(event, facility=facilities[index])
    place, level = entry.place, entry.level
    if place is None:
        vertex = int(random.integers(len(roadmap.position)))
        place, level = tuple(roadmap.position[vertex].tolist()), int(roadmap.level[vertex])
    return attrs.evolve(event, place=place, level=level, radius=entry.radius)


class FaultState:
    """The active faults during one execution.

    Args:
        settings: of the faults.
        events: what `draw_faults` returned.
        robots: their number.
    """

    def __init__(self, settings: Faults, events: Sequence[FaultEvent], robots: int) -> None:
        self.settings = settings
        self.events = tuple(events)
        self._robots = robots
        self._changes = sorted({time for event in events for time in (event.begin, event.end)})
        self._next = 0
        self.last_view: FleetView | None = None
        """What the dispatcher was told last."""
        self._ordered: Int32 = np.zeros(robots, np.int32)
        self._set(())

    def __bool__(self) -> bool:
        return bool(self.events)

    def update(self, now: float) -> tuple[Event, ...]:
        """Go to `now`, which never decreases; return the faults that began and ended since the last call, as events."""
        if self._next >= len(self._changes) or self._changes[self._next] > now + 1e-9:
            return ()
        since = self._changes[self._next]
        while self._next < len(self._changes) and self._changes[self._next] <= now + 1e-9:
            self._next += 1
        before = self._changes[self._next - 1]
        entries = [(e.begin, "fault", e, e.detail) for e in self.events if since <= e.begin <= before]
        entries += [(e.end, "fault_over", e, e.detail) for e in self.events if since <= e.end <= before]
        self._set(tuple(event for event in self.events if event.begin <= before < event.end))
        entries.sort(key=lambda entry: entry[0])
        return tuple(Event(stamp=at, kind=kind, robot=event.robot, detail=text) for at, kind, event, text in entries)

    def _set(self, active: tuple[FaultEvent, ...]) -> None:
        self.active = active
        """The active faults."""
        self.stopped = self._mask("stop")
        """bool[n]: robots that stand."""
        self.lost = self._mask("stop", for_good=True)
        """bool[n]: robots that stand for good."""
        self.silent = self._mask("silent")
        """bool[n]: robots that neither report nor receive anything."""
        self._blind = self._mask("lidar")
        self.speed: Float = np.ones(self._robots)
        """f8[n], relative to the usual one."""
        for event in active:
            if event.kind == "slow":
                self.speed[event.robot] *= event.speed
        self.broken = frozenset(event.facility for event in active if event.kind == "out_of_order")
        """Names of the doors and lifts that are out of order."""
        self.blockages = tuple(event for event in active if event.kind == "blocked")

    def _mask(self, kind: str, for_good: bool = False) -> Bool:
        mask = np.zeros(self._robots, bool)
        mask[[e.robot for e in self.active if e.kind == kind and (math.isinf(e.end) or not for_good)]] = True
        return mask

    @property
    def final(self) -> bool:
        """True if a fault is active, and no active one ends."""
        return bool(self.active) and all(math.isinf(event.end) for event in self.active)

    @property
    def obstacles(self) -> tuple[FaultEvent, ...]:
        """The active faults that others may go around."""
        return tuple(event for event in self.active if event.kind not in ("slow", "lidar"))

    def of_robot(self, robot: int) -> FaultEvent | None:
        """The fault that keeps a robot from going on: a stop, or else silence."""
        held = [event for event in self.active if event.robot == robot and event.kind in ("stop", "silent")]
        return min(held, key=lambda event: (event.kind != "stop", event.begin), default=None)

    def driven(self, twist: Float) -> Float:
        """The commands f8[n,2] that robots execute instead of `twist` f8[n,2]."""
        return twist * np.where(self.stopped, 0.0, self.speed)[:, None] if self.active else twist

    def scans(self, batches: Sequence[ScanBatch]) -> tuple[ScanBatch, ...]:
        """The scans of the lidars that work."""
        if not (self.active and self._blind.any()):
            return tuple(batches)
        works_of_batch = ((batch, ~self._blind[np.asarray(batch.robot)]) for batch in batches)
        return tuple(
            attrs.evolve(b, robot=b.robot[works], ranges=b.ranges[works]) for b, works in works_of_batch if works.any()
        )

    def reported_view(self, view: FleetView) -> FleetView:
        """What the dispatcher is told: of silent robots what it was told last."""
        last, self.last_view = self.last_view, view
        if last is not None and self.active and self.silent.any():
            silent = self.silent
            self.last_view = attrs.evolve(
                view,
                reached=np.where(silent, last.reached, view.reached),
                cleared=np.where(silent, last.cleared, view.cleared),
                pose=np.where(silent[:, None], last.pose, view.pose),
                level=np.where(silent, last.level, view.level),
                mode=np.where(silent, last.mode, view.mode),
            )
        return self.last_view

    def cut(self, cut: Int32) -> None:
        """Note that a new plan leaves out the first `cut` i4[n] segments of each path."""
        self._ordered = self._ordered - cut
        if self.last_view is not None:
            reached, cleared = self.last_view.reached - cut, np.maximum(self.last_view.cleared - cut, 0)
            self.last_view = attrs.evolve(self.last_view, reached=reached, cleared=cleared)

    def received(self, released: Int32) -> Int32:
        """The released segments i4[n] that robots know of: silent ones those of before."""
        self._ordered = np.where(self.silent, self._ordered, released).astype(np.int32)
        return self._ordered

    def held(self, commands: Mapping[str, float], facilities: Mapping[str, float]) -> dict[str, float]:
        """Return `commands` to doors and lifts, of which those out of order stay as they are.

        The doors of a lift (`lift/door`) fail with it.
        """
        stay = {
            name: position
            for name, position in facilities.items()
            if name in self.broken or name.partition("/")[0] in self.broken
        }
        return {**commands, **stay}


def approaches(place: Float, tail: Float, head: Float, clearance: Float) -> Bool:
    """Tell which straight moves bool[k] from `tail` to `head` f8[k,2] lead closer to a `place` f8[2] than `clearance`
    f8[k] metres, and closer than they begin: a robot that is close already may leave.
    """
    gap, begin = point_segment_distance(place, tail, head), np.hypot(*(tail - place).T)
    approaching: Bool = (gap < clearance - TOLERANCE) & (gap < begin - TOLERANCE)
    return approaching
