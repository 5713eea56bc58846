"""The crowd `scripted`: movers that follow given or recorded tracks, whatever robots do."""

import math
from itertools import pairwise
from pathlib import Path

import attrs
import numpy as np
from attrs import validators

from mrpbench_core.api import Crowd, CrowdSession, CrowdView, Mover, Movers, between, option
from mrpbench_core.api.crowd import in_body
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.table import read_rows
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import JUMP, LARGEST_RADIUS, LONGEST_KIND
from mrpbench_core.model.worlds.world import World

_COLUMNS = ("id", "t", "x", "y")


def _in_order(_: object, __: object, rows: tuple[tuple[float, float, float], ...]) -> None:
    if not np.isfinite(rows).all():
        raise ValueError("keyframes must be finite")
    if any(later[0] <= earlier[0] for earlier, later in pairwise(rows)):
        raise ValueError("the times of keyframes must increase")


@attrs.frozen(kw_only=True)
class Track:
    """The keyframes of one mover."""

    keyframes: tuple[tuple[float, float, float], ...] = option(
        help="rows of [t, x, y]: simulated seconds and metres; straight and with constant speed in between",
        validator=validators.and_(validators.min_len(1), _in_order),
    )
    level: int = option(0, help="index of the level", validator=validators.ge(0))
    loop: bool = option(False, help="begin again after the last keyframe, at the place of the first")
    jump: bool = option(False, help="begin again at once, without the way from the last keyframe back to the first")


@attrs.frozen(kw_only=True)
class Scripted(Crowd):
    """Moves along keyframes, or along the tracks of a CSV file. Nothing yields to robots: they push what they hit.

    The file has the columns `id`, `t`, `x`, `y` (any identifier, seconds, metres) and a row for each observation. A
    recorded person is there from its first observation to its last; one of `tracks` waits at both of its ends.
    """

    tracks: tuple[Track, ...] = option((), help="movers with their keyframes")
    file: Path | None = option(None, help="CSV file of recorded tracks")
    radius: float = option(0.3, help="radius of a body", unit="m", validator=between(0.01, LARGEST_RADIUS))
    legs: bool = option(True, help="lidars see two legs instead of the body")
    leg_radius: float = option(
        0.05, help="radius of a leg", unit="m", validator=validators.and_(validators.gt(0), in_body)
    )
    kind: str = option(
        "person",
        help="what moves, as pictures and bags name it",
        validator=validators.and_(validators.min_len(1), validators.max_len(LONGEST_KIND)),
    )

    def start(self, world: World, fleet: Fleet, seed: int, view: CrowdView) -> CrowdSession:  # noqa: ARG002
        """Begin all tracks.

        Raises:
            InputError: the file cannot be read, or a track leads through something solid.
        """
        recorded = _read(self.file) if self.file is not None else ()
        tracks = (*self.tracks, *recorded)
        for index, track in enumerate(tracks):
            if track.level >= len(world.levels):
                raise InputError(
                    f"crowds: track {index} is on level {track.level}, world {world.name} has no such level"
                )
            way = _way(track)
            clear = has_clearance(world.levels[track.level], way[:-1, 1:], way[1:, 1:], self.radius)
            if not clear.all():
                t, x, y = way[int((~clear).argmax())]
                where = f"at {t:g} s, near ({x:g}, {y:g})"
                raise InputError(f"crowds: track {index} touches something solid {where}", file=self.file)
        member = Mover(radius=self.radius, kind=self.kind, leg_radius=self.leg_radius if self.legs else 0.0)
        return ScriptedSession(tracks, len(self.tracks), member)


class ScriptedSession(CrowdSession):
    """Tracks under way; those from `given` on are recorded, and there only while they were observed."""

    def __init__(self, tracks: tuple[Track, ...], scripted: int, member: Mover) -> None:
        self.members = (member,) * len(tracks)
        self._ways = [_way(track) for track in tracks]
        self._loop = [track.loop for track in tracks]
        self._levels = np.array([track.level for track in tracks], np.int16)
        self._recorded = np.arange(len(tracks)) >= scripted
        self._now = 0.0
        self._yaw = np.array([_first_yaw(way) for way in self._ways])
        self._place = np.array([self._at(index, 0.0) for index in range(len(tracks))]).reshape(-1, 2)
        self._velocity = np.zeros((len(tracks), 2))

    @property
    def movers(self) -> Movers:
        """Where they are now, looking ahead."""
        first = np.array([way[0, 0] for way in self._ways])
        last = np.array([way[-1, 0] for way in self._ways])
        away = self._recorded & ((self._now < first) | (self._now > last))
        return Movers(
            pose=np.column_stack([self._place, self._yaw]),
            velocity=self._velocity,
            level=np.where(away, -1, self._levels).astype(np.int16),
        )

    def step(self, dt: float, view: CrowdView) -> Movers:  # noqa: ARG002
        """Follow the tracks for `dt` seconds."""
        self._now += dt
        place = np.array([self._at(index, self._now) for index in range(len(self._ways))]).reshape(-1, 2)
        moved = place - self._place
        self._velocity = np.where(np.hypot(*moved.T)[:, None] > JUMP, 0.0, moved / dt)
        moving = np.hypot(*self._velocity.T) > 1e-6
        self._yaw = np.where(moving, np.arctan2(self._velocity[:, 1], self._velocity[:, 0]), self._yaw)
        self._place = place
        return self.movers

    def _at(self, index: int, now: float) -> tuple[float, float]:
        way = self._ways[index]
        if self._loop[index] and now > way[0, 0] and len(way) > 1:
            now = way[0, 0] + (now - way[0, 0]) % (way[-1, 0] - way[0, 0])
        return float(np.interp(now, way[:, 0], way[:, 1])), float(np.interp(now, way[:, 0], way[:, 2]))


def _way(track: Track) -> Float:
    """Keyframes f8[k,3], at least two, which end where they begin if the track is a loop."""
    way = np.array(track.keyframes, float)
    if track.loop and not track.jump and len(way) > 1 and (way[-1, 1:] != way[0, 1:]).any():
        speed = np.hypot(*np.diff(way[:, 1:], axis=0).T).sum() / (way[-1, 0] - way[0, 0])
        back = math.dist(way[-1, 1:], way[0, 1:]) / max(speed, 0.1)  # as fast as on the way there
        way = np.vstack([way, (way[-1, 0] + back, *way[0, 1:])])
    return way if len(way) > 1 else np.vstack([way, way + (1.0, 0.0, 0.0)])


def _first_yaw(way: Float) -> float:
    moves = np.flatnonzero((np.diff(way[:, 1:], axis=0) != 0).any(axis=1))
    if not len(moves):
        return 0.0
    x, y = way[moves[0] + 1, 1:] - way[moves[0], 1:]
    return math.atan2(y, x)


def _read(file: Path) -> tuple[Track, ...]:
    """Read recorded tracks, in the order in which their first rows come.

    Raises:
        InputError: a column is missing, or a row holds no numbers; times of one track do not increase.
    """
    rows: dict[str, list[tuple[float, float, float]]] = {}
    for number, line in read_rows(file, _COLUMNS):
        try:
            row = float(line["t"]), float(line["x"]), float(line["y"])
        except (TypeError, ValueError):
            raise InputError("t, x and y must be numbers", file=file, line=number) from None
        earlier = rows.setdefault(line["id"], [])
        if not all(map(math.isfinite, row)) or (earlier and row[0] <= earlier[-1][0]):
            said = f"the times of {line['id']!r:.40} must increase, and numbers be finite"
            raise InputError(said, file=file, line=number)
        earlier.append(row)
    return tuple(Track(keyframes=tuple(keyframes)) for keyframes in rows.values())
