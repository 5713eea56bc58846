"""Worlds of the ROS `map_server`: an image, and a YAML file that defines its grey values.

Facts: the documentation of `nav2_map_server` (docs.nav2.org; the modes: API documentation of `MapMode`) and of ROS 1's
`map_server` (wiki.ros.org/map_server).
"""

import math
from typing import Literal

import attrs
import numpy as np

from mrpbench_core.api.component import Path, option
from mrpbench_core.api.world import WorldSource
from mrpbench_core.files import yaml
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.arrays import Bool
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Level, World
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.image import GreyscaleImage, read_image
from mrpbench_worlds_standard.rotation import rotate

KEYS = ("image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate", "mode")
MODES = ("trinary", "scale", "raw")
WORDS = {"yes": True, "on": True, "no": False, "off": False}
"""Truth values that map_server reads besides those of YAML 1.2."""
SAVED_AS_UNKNOWN = 205 / 255
"""Lightness that map_saver writes for unknown cells; they are free if `free_thresh` is 0.25, its own default."""
TOLERANCE = 1e-9
"""Rounding of a grey value, so that one that equals a threshold reaches it."""


@attrs.frozen(kw_only=True)
class RosMap(WorldSource):
    """A `map_server` map. Occupied cells are blocked, and so are unknown ones unless `unknown` is `free`.

    A pixel is occupied if its darkness (with `negate`: its lightness) is at least `occupied_thresh`, and otherwise free
    if it is at most `free_thresh`. Between the thresholds it is unknown in the mode `trinary`, and free in the mode
    `scale`, because only certain obstacles stop Nav2's planners. In the mode `raw` the grey value is the occupancy in
    percent: occupied from `occupied_thresh`, free below, and unknown above 100. Pixels that are not opaque are unknown
    in every mode. If the origin has a yaw, the map is rotated about the lower left corner of the image; it is resampled
    unless the yaw is a quarter turn.
    """

    file: Path = option(help="The .yaml file.")
    image: Path | None = option(None, help="The image to read instead of the one that the file names.")
    unknown: Literal["blocked", "free"] = option(
        "blocked",
        help="Whether unknown cells are blocked or free.",
        validator=attrs.validators.in_(["blocked", "free"]),
    )

    def reads(self) -> tuple[Path, ...]:
        """Return the image that the file names."""
        if self.image is not None:
            return ()
        try:
            document = yaml.load(self.file)
            return (self.file.parent / Node(document, document.data).fields()["image"].text(),)
        except (InputError, KeyError):  # `load` reports the error
            return ()

    def load(self) -> World:
        """Read the raster; no walls, no places, no lanes."""
        document = yaml.load(self.file)
        top = Node(document, document.data)
        fields = top.fields()
        for key in ("resolution", "origin", *(() if self.image else ("image",))):
            if key not in fields:
                raise top.error(f"has no {key!r}", "a ROS map_server file?")
        size = fields["resolution"].number()
        if size <= 0:
            raise fields["resolution"].error("resolution should be positive")
        x, y, *yaw = (value.number() for value in fields["origin"].items(least=2))
        image = self.image or self.file.parent / fields["image"].text()
        notes = [f"key {key!r} is not known and has no effect." for key in fields if key not in KEYS]
        pixels = read_image(image, fields.get("image", top))
        occupied, unknown = _classify(fields, pixels)
        blocked = occupied if self.unknown == "free" else occupied | unknown
        if not occupied.any():
            notes.append("no cell is occupied, so the map has no walls (image, mode, negate, occupied_thresh).")
        elif (np.isclose(pixels.lightness, SAVED_AS_UNKNOWN)[pixels.tone] & ~occupied & ~unknown).any():
            notes.append("cells of the grey 205, by which map_saver means unknown, are free (mode, free_thresh).")
        if blocked.all():
            notes.append("no cell is free (image, mode, negate, free_thresh; option unknown).")
        occupancy = Occupancy(blocked=blocked[::-1], resolution=size, origin=(x, y))
        angle = math.remainder(yaw[0] if yaw else 0.0, 2 * math.pi)
        if not math.isclose(angle, round(angle / (math.pi / 2)) * math.pi / 2, abs_tol=1e-6):
            notes.append(f"the map is rotated by {math.degrees(angle):.2f}° and resampled.")
        level = Level(name="L1", occupancy=rotate(occupancy, angle))
        return World(name=self.file.name.split(".")[0], levels=(level,), notes=tuple(notes))


def _classify(fields: dict[str, Node], image: GreyscaleImage) -> tuple[Bool, Bool]:
    """Which cells are occupied and which unknown, both bool[rows, columns], row 0 at the top."""
    high, low = _share(fields, "occupied_thresh", 0.65), _share(fields, "free_thresh", 0.25)
    if low > high:
        raise fields["free_thresh" if "free_thresh" in fields else "occupied_thresh"].error(
            f"free_thresh {low:g} should not exceed occupied_thresh {high:g}"
        )
    mode = fields["mode"].text().lower() if "mode" in fields else "trinary"
    if mode not in MODES:
        raise fields["mode"].error(f"mode {mode!r} is not known", f"modes: {', '.join(MODES)}")
    if mode == "raw":
        percent = np.rint(image.lightness * 255)
        occupied, unknown = (percent >= high * 100 - TOLERANCE) & (percent <= 100), percent > 100
    else:
        occupancy = image.lightness if _flag(fields, "negate") else 1 - image.lightness
        occupied = occupancy >= high - TOLERANCE
        between = (occupancy > low + TOLERANCE) & ~occupied
        unknown = between if mode == "trinary" else np.zeros_like(between)
    return occupied[image.tone] & image.opaque, unknown[image.tone] | ~image.opaque


def _share(fields: dict[str, Node], key: str, default: float) -> float:
    if key not in fields:
        return default
    value = fields[key].number()
    if not 0 <= value <= 1:
        raise fields[key].error(f"{key} should lie between 0 and 1, not {value:g}")
    return value


def _flag(fields: dict[str, Node], key: str) -> bool:
    value = fields[key].value if key in fields else False
    value = WORDS.get(str(value).lower(), value)
    if value not in (0, 1):
        raise fields[key].error(f"{key} should be 0 or 1, not {value!r}")
    return bool(value)
