"""Sites of Open-RMF's site editor (`.site.json`), as the building file that says the same.

Read in open-rmf/rmf_site (2026-06): objects are records by ids that are unique in the file, anchors are metres with y
up, and defaults are left out. Everything after this module reads buildings, whichever editor drew them.
"""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mrpbench_core.files import yaml
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import Document
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes

VERSIONS = ("0.1",)
"""Versions of the format that are known."""
NEAR = 1.0
"""Metres from a location at which a robot that stands there is taken to begin at it."""
_TAGS = {"Charger": "is_charger", "ParkingSpot": "is_parking_spot", "HoldingPoint": "is_holding_point"}
_FACING = {"Forwards": "forward", "Backwards": "backward"}
_SEVERAL = ("AllExcept", "Only")


def is_site(file: Path) -> bool:
    """Tell whether a file is one of the site editor.

    Raises:
        InputError: it is one in Rusty Object Notation.
    """
    if file.suffix == ".ron":
        raise InputError("sites in RON are not read", file=file, hint="export it as JSON (.site.json)")
    return file.suffix == ".json"


def read_site(file: Path, notes: Notes) -> Document:
    """Return the building of a site.

    Raises:
        InputError: it is not a site of a known version, or an object names what does not exist.
    """
    document = yaml.load(file)
    building = _Site(Node(document, document.data), notes).building()
    return yaml.loads(json.dumps(building), file=file)


class _Site:
    """A site, and where its anchors are."""

    def __init__(self, root: Node, notes: Notes) -> None:
        self._root, self._notes = root, notes
        parts = root.fields()
        version = parts.get("format_version")
        if version is None or version.text() not in VERSIONS:
            at = root if version is None else version
            said = "has no format_version" if version is None else f"format_version {version.text()} is not known"
            raise at.error(said, f"known: {', '.join(VERSIONS)}")
        self._levels = _section(root, "levels")
        self._guided = _section(_part(root, "navigation"), "guided")
        self._index: dict[str, tuple[str, int]] = {}
        """The level of each anchor, and its index among the anchors there."""
        self._places: dict[str, list[tuple[float, float]]] = {}
        for key, level in self._levels.items():
            anchors = _section(level, "anchors")
            self._places[key] = [_place(anchor) for anchor in anchors.values()]
            self._index |= {anchor: (key, index) for index, anchor in enumerate(anchors)}
        lanes = _section(self._guided, "lanes").values()
        ends = [{self._index.get(str(it.integer()), ("", -1))[0] for it in lane.section("anchors")} for lane in lanes]
        apart = sum(len(levels) > 1 or "" in levels for levels in ends)
        notes.add("lane that is not on one level is left out", apart)
        if _section(root, "lifts"):
            notes.add("lifts of sites are not read: lanes to their cabins are left out", len(_section(root, "lifts")))

    def building(self) -> dict[str, Any]:
        """The building that says the same."""
        parameters = self._vertex_parameters()
        levels = {_name(level, key): self._level(key, level, parameters) for key, level in self._levels.items()}
        if len(levels) < len(self._levels):
            raise _part(self._root, "levels").error("two levels have the same name")
        return {"name": _name(self._root, ""), "coordinate_system": "cartesian_meters", "levels": levels}

    def _level(self, key: str, level: Node, parameters: dict[str, tuple[str, dict[str, Any]]]) -> dict[str, Any]:
        anchors = zip(_section(level, "anchors"), self._places[key], strict=True)
        elevation = _part(level, "properties").fields().get("elevation")
        vertices = [[x, y, 0, *parameters.get(anchor, ("", {}))] for anchor, (x, y) in anchors]
        return {
            "elevation": 0.0 if elevation is None else elevation.number(),
            "vertices": vertices,
            "walls": [[*self._ends(key, wall), {}] for wall in _section(level, "walls").values()],
            "floors": [
                {"vertices": [self._at(key, anchor) for anchor in floor.section("anchors")], "parameters": {}}
                for floor in _section(level, "floors").values()
            ],
            "doors": [[*self._ends(key, door), _door(door)] for door in _section(level, "doors").values()],
            "lanes": [*self._lanes(key)],
            "models": [*self._models(key)],
        }

    def _at(self, level: str, anchor: Node) -> int:
        """The index of an anchor on a level."""
        found, index = self._index.get(str(anchor.integer()), ("", -1))
        if found != level:
            raise anchor.error(f"anchor {anchor.integer()} is not on this level")
        return index

    def _ends(self, level: str, owner: Node) -> list[int]:
        anchors = owner.section("anchors")
        if len(anchors) != 2:
            raise owner.error(f"should have two anchors, not {len(anchors)}")
        return [self._at(level, anchor) for anchor in anchors]

    def _lanes(self, level: str) -> Iterator[list[Any]]:
        """The lanes of a level, once for each graph that they belong to."""
        mutexes = {key: _name(group, key) for key, group in _section(self._root, "mutex_groups").items()}
        for lane in _section(self._guided, "lanes").values():
            ends = [self._index.get(str(anchor.integer()), ("", -1)) for anchor in lane.section("anchors")]
            if len(ends) != 2:
                raise lane.error(f"a lane should have two anchors, not {len(ends)}")
            if {key for key, _ in ends} != {level}:
                continue
            for graph in self._graphs(lane):
                yield [*(index for _, index in ends), self._lane(lane, graph, mutexes)]

    def _lane(self, lane: Node, graph: int, mutexes: dict[str, str]) -> dict[str, Any]:
        parts = lane.fields()
        forward, reverse = _part(lane, "forward").fields(), parts.get("reverse")
        different = reverse is not None and isinstance(reverse.value, dict)
        if different:
            self._notes.add("lane whose way back has a motion of its own gets that of its way there")
        one_way = reverse is not None and reverse.value == "Disable"
        found: dict[str, Any] = {"graph_idx": [2, graph], "bidirectional": [4, not one_way]}
        if (limit := forward.get("speed_limit")) is not None and limit.value is not None:
            found["speed_limit"] = [3, limit.number()]
        facing = forward.get("orientation_constraint")
        if facing is not None and isinstance(facing.value, str) and facing.value in _FACING:
            found["orientation"] = [1, _FACING[facing.value]]
        elif facing is not None and facing.value not in (None, "None"):
            self._notes.add("orientation of a lane that is neither Forwards nor Backwards has no effect")
        if "dock" in forward:
            self._notes.add("dock at the end of a lane has no effect")
        if (mutex := _mutex(lane)) is not None:
            found["mutex"] = [1, mutexes.get(mutex, mutex)]
        return found

    def _graphs(self, owner: Node) -> list[int]:
        """The numbers of the graphs that a lane belongs to."""
        known = list(_section(self._guided, "graphs"))
        stated = [str(it.integer()) for it in self._guided["ranking"].items()] if "ranking" in self._guided else []
        order = [key for key in stated if key in known] + [key for key in known if key not in stated]
        given = owner.fields().get("graphs")
        if given is None or given.value == "All" or not order:
            return list(range(len(order))) or [0]
        for word in _SEVERAL:
            if isinstance(given.value, dict) and word in given.value:
                ids = {str(it.integer()) for it in given.fields()[word].items()}
                return [index for index, key in enumerate(order) if (key in ids) == (word == "Only")]
        raise given.error("should be All, Only or AllExcept")

    def _vertex_parameters(self) -> dict[str, tuple[str, dict[str, Any]]]:
        """Name and parameters of each anchor that is a location, and of robots that stand there."""
        mutexes = {key: _name(group, key) for key, group in _section(self._root, "mutex_groups").items()}
        found: dict[str, tuple[str, dict[str, Any]]] = {}
        for location in _section(self._guided, "locations").values():
            parts = location.fields()
            if "anchor" not in parts:
                raise location.error("a location needs an anchor")
            tags = _part(location, "tags").items()
            parameters: dict[str, Any] = {
                _TAGS[tag.value]: [4, True] for tag in tags if isinstance(tag.value, str) and tag.value in _TAGS
            }
            if any(not isinstance(tag.value, str) or tag.value not in _TAGS for tag in tags):
                self._notes.add("tag of a location that is neither a charger nor a place to wait has no effect")
            if (mutex := _mutex(location)) is not None:
                parameters["mutex"] = [1, mutexes.get(mutex, mutex)]
            found[str(parts["anchor"].integer())] = (_text(parts.get("name")), parameters)
        self._add_robots(found)
        return found

    def _add_robots(self, found: dict[str, tuple[str, dict[str, Any]]]) -> None:
        """Let the robots of the site begin at the locations where they stand."""
        kinds = _section(self._root, "robots")
        names = _section(self._root, "model_descriptions")
        for key, node in kinds.items():
            self._notes.add(f"robot {_name(names.get(key, node), key)!r}: {_robot(node)}; the study's `fleet` decides")
        for level, robot, kind, place, _ in self._instances():
            if kind not in kinds:
                continue
            near = [(away, anchor) for anchor in found if (away := self._distance(anchor, level, place)) <= NEAR]
            if near:
                parameters = found[min(near)[1]][1]
                parameters["spawn_robot_name"] = [1, _text(robot.fields().get("name"))]
                parameters["spawn_robot_type"] = [1, _source(names[kind]) if kind in names else kind]
            else:
                self._notes.add("robot that stands at no location begins where the scenario says")

    def _distance(self, anchor: str, level: str, place: tuple[float, float]) -> float:
        """Metres from an anchor to a place on a level; inf if it is on another one."""
        at, index = self._index.get(anchor, ("", -1))
        return math.dist(place, self._places[at][index]) if at == level else math.inf

    def _models(self, level: str) -> Iterator[dict[str, Any]]:
        """The furniture of a level."""
        names, robots = _section(self._root, "model_descriptions"), _section(self._root, "robots")
        for key, model, kind, (x, y), (z, yaw) in self._instances():
            if key != level or kind in robots:
                continue
            if kind not in names:
                raise model.error(f"model description {kind} does not exist")
            place = {"x": x, "y": y, "z": z, "yaw": yaw}
            yield {"model_name": _source(names[kind]), "name": _text(model.fields().get("name")), **place}

    def _instances(self) -> Iterator[tuple[str, Node, str, tuple[float, float], tuple[float, float]]]:
        """Level, node, description, position, and height and yaw of each model, as in the first scenario."""
        scenario = next(iter(_section(self._root, "scenarios").values()), None)
        changes = {} if scenario is None else _section(scenario, "instances")
        for key, model in _section(self._root, "model_instances").items():
            parts, change = model.fields(), changes[key].fields() if key in changes else {}
            inclusion = change.get("inclusion")
            if inclusion is not None and inclusion.value == "Hidden":
                continue
            pose, level = change.get("pose", parts.get("pose")), change.get("on_level", parts.get("parent"))
            if pose is None or level is None or "description" not in parts:
                raise model.error("a model needs a pose, a level and a description")
            x, y, z = (value.number() for value in _part(pose, "trans").items(least=3)[:3])
            yield str(level.integer()), model, str(parts["description"].integer()), (x, y), (z, _yaw(pose))


def _part(node: Node, key: str) -> Node:
    """A part of a record; nothing if it is left out."""
    return node.fields().get(key, Node(node.document, None, (*node.steps, key)))


def _section(node: Node | dict[str, Node], key: str) -> dict[str, Node]:
    """The records of a section by id."""
    if isinstance(node, dict):
        return node[key].fields() if key in node else {}
    return _part(node, key).fields()


def _name(node: Node, otherwise: str) -> str:
    stated = node.fields().get("name", _part(node, "properties").fields().get("name"))
    return otherwise if stated is None else stated.text()


def _text(node: Node | None) -> str:
    return "" if node is None or node.value is None else node.text()


def _place(anchor: Node) -> tuple[float, float]:
    parts = anchor.fields()
    if "Translate2D" in parts:
        x, y = parts["Translate2D"].items(least=2)[:2]
    elif "Pose3D" in parts:
        x, y = _part(parts["Pose3D"], "trans").items(least=2)[:2]
    else:
        raise anchor.error("an anchor should be Translate2D or Pose3D")
    return x.number(), y.number()


def _yaw(pose: Node) -> float:
    """The rotation about the vertical axis in radians."""
    rotation = _part(pose, "rot").fields()
    if "yaw" in rotation:
        return _angle(rotation["yaw"])
    if "euler_xyz" in rotation:
        return _angle(rotation["euler_xyz"].items(least=3)[2])
    if "quat" in rotation:
        x, y, z, w = (value.number() for value in rotation["quat"].items(least=4)[:4])
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return 0.0


def _angle(node: Node) -> float:
    parts = node.fields()
    if "deg" in parts:
        return math.radians(parts["deg"].number())
    if "rad" in parts:
        return parts["rad"].number()
    raise node.error("an angle should be in deg or rad")


def _door(door: Node) -> dict[str, Any]:
    """The parameters of a door; `Backward` swings are those with the motion direction 1, and `Left` is its start."""
    kinds = _part(door, "kind").fields()
    (kind, node), *_ = [*kinds.items(), ("SingleSliding", Node(door.document, None, door.steps))]
    parts = node.fields()
    left = parts.get("pivot_on", parts.get("towards"))
    found: dict[str, Any] = {
        "name": [1, _text(door.fields().get("name"))],
        "motion_axis": [1, "end" if left is not None and left.value == "Right" else "start"],
    }
    types = {"SingleSwing": "hinged", "DoubleSwing": "double_hinged", "SingleSliding": "sliding"}
    found["type"] = [1, (types | {"DoubleSliding": "double_sliding"}).get(kind, kind)]
    if (ratio := parts.get("left_right_ratio")) is not None:
        if ratio.number() <= 0:
            raise ratio.error("left_right_ratio should be positive")
        found["right_left_ratio"] = [3, 1 / ratio.number()]
    for word, swing in _part(node, "swing").fields().items():
        way, angle = (word, swing) if word != "Both" else ("Backward", swing.fields().get("backward", swing))
        found["motion_direction"] = [2, 1 if way == "Backward" else -1]
        found["motion_degrees"] = [3, math.degrees(_angle(angle))]
    return found


def _mutex(node: Node) -> str | None:
    stated = node.fields().get("mutex")
    return None if stated is None or stated.value is None else str(stated.integer())


def _source(description: Node) -> str:
    """The name of a model as building files have it."""
    source = _part(description, "source").fields()
    return next((value.text() for value in source.values()), "") or _name(description, "")


def _robot(kind: Node) -> str:
    """What a site says of a kind of robot, in one line."""
    words = {
        "radius": "radius {:g} m",
        "translational_speed": "{:g} m/s",
        "rotational_speed": "{:g} rad/s",
        "capacity": "{:g} Ah",
        "voltage": "{:g} V",
        "charging_current": "charges with {:g} A",
    }
    configs = [_part(part, "config").fields() for part in _section(kind, "properties").values()]
    said = [text.format(config[key].number()) for key, text in words.items() for config in configs if key in config]
    return ", ".join(said) or "nothing is said of it"
