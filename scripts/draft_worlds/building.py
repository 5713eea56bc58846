"""Writes building files of the RMF traffic editor, in metres, in the layout of our built-in worlds."""

from collections.abc import Mapping, Sequence
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

    def people(self, goal_set: str, *points: tuple[float, float]) -> None:
        """Places of people, outside of the navigation graph."""
        drawn = sum(goal_set in parameters for _, _, parameters in self.places.values())
        for number, (x, y) in enumerate(points, drawn + 1):
            self.place(f"{goal_set}_{number}", x, y, f"human_goal_set_name={goal_set}")

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


Routine = Mapping[str, tuple[tuple[float, float], Mapping[str, float]]]
"""For each goal set the seconds for which people stay there, and the weights of the sets to which they go next."""


def crowd_sim(routine: Routine, groups: Sequence[tuple[str, int, float, float]]) -> list[str]:
    """The lines of that section: people walk to a place of a set (state `to_SET`) and stay (`at_SET`).

    Args:
        routine: what people do.
        groups: the set to which people go first, how many they are, and x and y near which they begin.
    """
    text = ["crowd_sim:", "  enable: 1", "  goal_sets:"]
    for index, name in enumerate(routine):
        text.append(f"    - {{set_id: {index}, set_area: [{name}], capacity: 10}}")
    text.append("  states:  # people walk to a place of a set, and stay there")
    for index, name in enumerate(routine):
        text.append(f"    - {{name: to_{name}, goal_set: {index}, final: 0}}")
        text.append(f"    - {{name: at_{name}, goal_set: -1, final: 0}}")
    text.append("  transitions:")
    for name, ((least, most), following) in routine.items():
        there = "{type: goal_reached, distance: 0.5}"
        text.append(f"    - {{from: to_{name}, to: at_{name}, Condition: {there}}}")
        stay = f"{{type: timer, dist: u, min: {number(least)}, max: {number(most)}, per_agent: true}}"
        targets = ", ".join(f"{{name: to_{other}, weight: {number(weight)}}}" for other, weight in following.items())
        text.append(f"    - {{from: at_{name}, Condition: {stay},")
        text.append(f"       Target: [{targets}]}}")
    text.append("  agent_groups:")
    for index, (name, count, x, y) in enumerate(groups, 1):
        where = f"x: {number(x)}, y: {number(y)}"
        text.append(f"    - {{group_id: {index}, agents_number: {count}, {where}, state_selector: to_{name}}}")
    return text


def write(file: Path, title: str, *levels: DraftLevel, lifts: Sequence[str] = (), people: Sequence[str] = ()) -> None:
    """A whole building file; `title` is its head comment, `lifts` and `people` are the lines of those sections."""
    text = [*(f"# {line}" for line in title.splitlines()), f"name: {file.name.split('.')[0]}"]
    text += ["coordinate_system: cartesian_meters", *(["lifts:", *lifts] if lifts else ["lifts: {}"]), "levels:"]
    text += [line for level in levels for line in level.lines()]
    file.write_text("\n".join([*text, *people]) + "\n", encoding="utf-8")
