"""Writes building files of the RMF traffic editor, in metres, in the layout of our built-in worlds."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path


def number(value: float) -> str:
    """At most three decimals, no trailing zeros."""
    return f"{value + 0.0:.3f}".rstrip("0").rstrip(".") if abs(value) >= 5e-4 else "0"


class DraftLevel:
    """Places, walls, doors, lanes and furniture of one level, in order of drawing."""

    def __init__(self, name: str, elevation: float = 0.0) -> None:
        self.name, self.elevation = name, elevation
        self.places: dict[str, tuple[float, float, str]] = {}
        self.corners: dict[tuple[str, str], int] = {}
        self.walls: list[str] = []
        self.doors: list[str] = []
        self.lanes: list[str] = []
        self.models: list[str] = []

    def place(self, name: str, x: float, y: float, *parameters: str) -> str:
        """A vertex of the navigation graph; parameters such as `is_charger` or `pickup_dispenser=NAME`."""
        assert name not in self.places, name
        pairs = [parameter.split("=") for parameter in parameters]
        stated = ", ".join(f"{key}: [1, {value[0]}]" if value else f"{key}: [4, true]" for key, *value in pairs)
        self.places[name] = (x, y, f", {{{stated}}}" if stated else "")
        return name

    def lane(self, *names: str, one_way: bool = False) -> None:
        """Lanes through these places, one after the other."""
        index = list(self.places)
        way = "false" if one_way else "true"
        for start, end in pairwise(names):
            self.lanes.append(f"[{index.index(start)}, {index.index(end)}, {{bidirectional: [4, {way}]}}]")

    def remark(self, text: str) -> None:
        """A comment above the next walls."""
        self.walls.append(f"# {text}")

    def wall(self, *points: tuple[float, float]) -> None:
        """Walls along a line of points."""
        for start, end in pairwise(points):
            self.walls.append(f"- [{{{self.corner(*start)}}}, {{{self.corner(*end)}}}]")

    def wall_with_gaps(
        self, fixed: float, first: float, last: float, gaps: list[tuple[float, float]], axis: str
    ) -> None:
        """A straight wall along x (`axis` x, at y = fixed) or y, with gaps (middle, width between its ends)."""
        stops = [
            first,
            *(edge for middle, width in sorted(gaps) for edge in (middle - width / 2, middle + width / 2)),
            last,
        ]
        for a, b in zip(stops[::2], stops[1::2], strict=True):
            if b - a > 1e-6:
                self.wall(*(((a, fixed), (b, fixed)) if axis == "x" else ((fixed, a), (fixed, b))))

    def door(
        self, name: str, start: tuple[float, float], end: tuple[float, float], kind: str = "hinged", direction: int = 1
    ) -> None:
        """A door between two points, in a gap of the walls. From start to end, direction 1 opens to the right."""
        options = f"name: [1, {name}], type: [1, {kind}], motion_axis: [1, start], motion_direction: [2, {direction}]"
        if "hinged" in kind:
            options += ", motion_degrees: [3, 90]"
        self.doors.append(f"- [{{{self.corner(*start)}}}, {{{self.corner(*end)}}}, {{{{{options}}}}}]")

    def model(self, model: str, x: float, y: float, yaw: float = 0.0) -> None:
        """Furniture by the name of its footprint."""
        where = f"x: {number(x)}, y: {number(y)}, z: 0, yaw: {yaw:.6g}"
        self.models.append(f"- {{model_name: {model}, name: {model.lower().replace(' ', '_')}, {where}, static: true}}")

    def corner(self, x: float, y: float) -> int:
        """The number of a corner of walls among the corners."""
        return self.corners.setdefault((number(x), number(y)), len(self.corners))

    def lines(self) -> list[str]:
        """The level's part of the file."""
        first = len(self.places)
        text = [f"  {self.name}:", f"    elevation: {number(self.elevation)}"]
        text.append("    vertices:  # [x, y, z, name, parameters]; metres")
        for index, (name, (x, y, parameters)) in enumerate(self.places.items()):
            text.append(f"      - [{number(x)}, {number(y)}, 0, {name}{parameters}]  # {index}")
        text.append("      # corners of walls")
        text += [f'      - [{x}, {y}, 0, ""]  # {first + index}' for (x, y), index in self.corners.items()]
        numbers = [first + index for index in range(len(self.corners))]
        text.append("    walls:")
        text += [f"      {line.format(*numbers) if line[0] == '-' else line}" for line in self.walls]
        if self.doors:
            text.append("    doors:")
            text += [f"      {line.format(*numbers)}" for line in self.doors]
        text.append("    lanes:")
        text += [f"      - {line}" for line in self.lanes]
        if self.models:
            text.append("    models:  # footprints by name: footprints.yaml beside this file")
            text += [f"      {line}" for line in self.models]
        return text


def write(file: Path, title: str, *levels: DraftLevel, lifts: Sequence[str] = ()) -> None:
    """A whole building file; `title` is its head comment, `lifts` are the lines of that section."""
    text = [*(f"# {line}" for line in title.splitlines()), f"name: {file.name.split('.')[0]}"]
    text += ["coordinate_system: cartesian_meters", *(["lifts:", *lifts] if lifts else ["lifts: {}"]), "levels:"]
    text += [line for level in levels for line in level.lines()]
    file.write_text("\n".join(text) + "\n", encoding="utf-8")
