"""Writes a run as a GIF of a few seconds."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.model.worlds.doors import leaf_segments
from mrpbench_core.model.worlds.facilities import Facilities
from mrpbench_core.report.pictures.movers import read_movers
from mrpbench_core.report.pictures.style import COLOURS, PERSON, WALL
from mrpbench_core.report.pictures.world import world_figure
from mrpbench_core.store.recording import Recording
from mrpbench_replay.motion import read_levels

PIXELS = 800
FRAME_MS = 80
LENGTH_S = 10.0
"""Longest duration of the animation, seconds."""
HOLD_MS = 1500
"""Duration of the last frame."""
LEAST = 5.0
"""Smallest radius in pixels with which a robot is drawn."""
WORLD_COLOURS, SHADES = 128, 12
"""Of the 256 colours of a GIF: the number for the world, and the number of shades of each robot."""
CROWD = 60
"""Number of robots above which trails are thinner."""
DISC = np.column_stack([fn(np.arange(24) * np.pi / 12) for fn in (np.cos, np.sin)])
"""Outline f8[24,2] of a disc of radius 1."""


def write_gif(recording: Recording, file: Path) -> None:
    """Animate the robots and their trails on the level with most robots.

    Raises:
        InputError: matplotlib is missing, nothing was recorded, or the file cannot be written.
    """
    context = recording.context()
    times, levels = read_levels(recording)
    level, poses = next(iter(levels.items()))
    speed = max(1.0, (times[-1] - times[0]) / LENGTH_S)
    moments = np.arange(times[0], times[-1] + 1e-9, speed * FRAME_MS / 1000)
    if moments[-1] < times[-1]:
        moments = np.append(moments, times[-1])
    figure, axes = world_figure(context.world, truth=poses, level=level, faint=True, pixels=PIXELS, shut=False)
    frames = _Frames(figure, axes, context.fleet, len(poses[0]), context.movers)
    doors = _doors(recording, level)
    movers = read_movers(recording, level)
    images = [frames.draw(poses, movers, times, moment, f"{moment:.1f} s  ×{speed:.3g}", doors) for moment in moments]
    shared = _share_palette(images)
    durations = [FRAME_MS] * (len(shared) - 1) + [HOLD_MS]
    try:
        shared[0].save(
            file, format="GIF", save_all=True, append_images=shared[1:], duration=durations, loop=0, optimize=False
        )
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None


def _doors(recording: Recording, level: int) -> Callable[[int], list[Float]]:
    """Return a function that gives the door leaves on a level at a sample, as lines f8[2,2]; none if not recorded."""
    facilities = Facilities(recording.context().world)
    if "facility" not in recording.channels:
        return lambda sample: []  # noqa: ARG005 - not recorded
    doing = recording.channel("facility")
    here = [door for door in facilities.doors if level in door.levels]

    def at(sample: int) -> list[Float]:
        state = dict(zip(facilities.names, doing[sample].tolist(), strict=True))
        lines = [leaf_segments(door.door, facilities.opening(door, state, level)) for door in here]
        return list(np.concatenate([np.empty((0, 4)), *lines]).reshape(-1, 2, 2))

    return at


def _share_palette(images: list[Any]) -> list[Any]:
    """Use the same colours in all frames, which would flicker otherwise: the world's, and shades of each robot's."""
    from PIL import Image

    world = images[0].quantize(colors=WORLD_COLOURS).getpalette()[: 3 * WORLD_COLOURS]
    full = np.array([[int(colour[at : at + 2], 16) for at in (1, 3, 5)] for colour in COLOURS])
    shades = [np.rint(255 + share * (full - 255)).astype(int) for share in np.linspace(0.2, 1, SHADES)]
    palette = Image.new("P", (1, 1))
    palette.putpalette([*world, *np.concatenate(shades).ravel().tolist()])
    return [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]


class _Frames:
    """Draws the robots of each frame over the same picture of the world."""

    def __init__(self, figure: Any, axes: Any, fleet: Fleet, robots: int, movers: Sequence[Mover]) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.collections import LineCollection, PolyCollection

        canvas: Any = FigureCanvasAgg(figure)
        self.canvas = canvas
        self.axes = axes
        colours = [COLOURS[robot % len(COLOURS)] for robot in range(robots)]
        width = 1.2 if robots <= CROWD else 0.6
        self.trails = LineCollection([], colors=colours, linewidths=width, alpha=0.6, zorder=6, animated=True)
        self.bodies = PolyCollection(
            [], facecolors=colours, edgecolors="white", linewidths=0.4, zorder=9, animated=True
        )
        self.people = PolyCollection([], facecolors="white", edgecolors=PERSON, linewidths=1.0, zorder=8, animated=True)
        self.leaves = LineCollection([], colors=WALL, linewidths=1.4, zorder=5, animated=True)
        self.noses = LineCollection([], colors="white", linewidths=1.0, zorder=10, animated=True)
        self.clock = axes.text(
            1, 1.01, "", transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color="#51606e", animated=True
        )
        for artist in (self.leaves, self.trails, self.people, self.bodies, self.noses):
            axes.add_collection(artist)
        canvas.draw()
        self.ground = canvas.copy_from_bbox(figure.bbox)
        metre = float(np.diff(axes.transData.transform([(0, 0), (1, 0)])[:, 0])[0])
        self.discs = [DISC * max(body.radius, LEAST / metre) for body in movers]
        self.shapes = [robot.footprint * max(1.0, LEAST / (robot.radius * metre)) for robot in fleet.robots]

    def draw(
        self, poses: Float, movers: Float, times: Float, moment: float, text: str, doors: Callable[[int], list[Float]]
    ) -> Any:
        """Draw the frame of a moment as a Pillow image."""
        from PIL import Image

        sample = max(int(np.searchsorted(times, moment, side="right")) - 1, 0)
        now = poses[sample]
        self.leaves.set_segments(doors(sample))
        self.trails.set_segments(list(poses[: sample + 1, :, :2].swapaxes(0, 1)))
        self.people.set_verts([disc + at[:2] for disc, at in zip(self.discs, movers[sample], strict=True)])
        cos, sin = np.cos(now[:, 2]), np.sin(now[:, 2])
        turns = np.stack([np.stack([cos, sin], axis=1), np.stack([-sin, cos], axis=1)], axis=1)
        self.bodies.set_verts(
            [shape @ turn + pose[:2] for shape, turn, pose in zip(self.shapes, turns, now, strict=True)]
        )
        reach = np.array([shape[:, 0].max() for shape in self.shapes])
        tips = now[:, :2] + turns[:, 0] * reach[:, None]
        self.noses.set_segments(list(np.stack([now[:, :2], tips], axis=1)))
        self.clock.set_text(text)
        self.canvas.restore_region(self.ground)
        for artist in (self.leaves, self.trails, self.people, self.bodies, self.noses, self.clock):
            self.axes.draw_artist(artist)
        return Image.fromarray(np.asarray(self.canvas.buffer_rgba())[..., :3].copy())
