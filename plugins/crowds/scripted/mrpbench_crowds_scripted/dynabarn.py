"""The moving obstacles of the worlds of the DynaBARN challenge."""

from collections import defaultdict
from pathlib import Path

import attrs

from mrpbench_core.api import Crowd, CrowdSession, CrowdView, Mover, option
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.table import read_rows
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.worlds.world import World
from mrpbench_crowds_scripted.scripted import ScriptedSession, Track

RADIUS = 0.5
"""metres, of all obstacles of the challenge."""


@attrs.frozen(kw_only=True)
class DynaBarnObstacles(Crowd):
    """Cylinders that cross the world `dynabarn` on their tracks, again and again, whatever the robot does.

    The tracks exist only inside compiled plugins of the challenge. `worlds` names the obstacles of each world (columns
    world, class, index), `keyframes` has their tracks (class, index, t, x, y: seconds and metres, straight and with
    constant speed in between). After its last keyframe an obstacle begins again at its first. Files may be compressed
    (`.gz`).
    """

    worlds: Path = option(help="CSV table with columns world, class, index")
    keyframes: Path = option(help="CSV table with columns class, index, t, x, y")
    index: int = option(help="number of the world")

    def start(self, world: World, fleet: Fleet, seed: int, view: CrowdView) -> CrowdSession:  # noqa: ARG002
        """Begin all tracks of a world; as in the challenge, they may lead through walls.

        Raises:
            InputError: a table cannot be read, or lacks the world or one of its obstacles.
        """
        worlds = read_rows(self.worlds, ("world", "class", "index"))
        chosen = [(row["class"], row["index"]) for _, row in worlds if row["world"] == str(self.index)]
        if not chosen:
            raise InputError(f"has no world {self.index}", file=self.worlds)
        keyframes: dict[tuple[str, str], list[tuple[float, float, float]]] = defaultdict(list)
        for line, row in read_rows(self.keyframes, ("class", "index", "t", "x", "y")):
            key = row["class"], row["index"]
            if key not in chosen:
                continue
            try:
                keyframes[key].append((float(row["t"]), float(row["x"]), float(row["y"])))
            except (TypeError, ValueError):
                raise InputError("t, x and y must be numbers", file=self.keyframes, line=line) from None
        tracks = []
        for key in chosen:
            if key not in keyframes:
                raise InputError(f"has no obstacle {' '.join(key)}", file=self.keyframes)
            try:
                tracks.append(Track(keyframes=tuple(keyframes[key]), loop=True, jump=True))
            except ValueError as error:
                raise InputError(f"obstacle {' '.join(key)}: {error}", file=self.keyframes) from None
        return ScriptedSession(tuple(tracks), len(tracks), Mover(radius=RADIUS, kind="obstacle", leg_radius=0.0))
