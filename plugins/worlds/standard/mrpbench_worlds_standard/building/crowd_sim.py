"""The people of a building file: `crowd_sim`, whose states walk to vertices with a `human_goal_set_name`."""

from collections import defaultdict
from collections.abc import Sequence
from typing import Any

import attrs
import numpy as np

from mrpbench_core.model.worlds.routines import Activity, PeopleGroup
from mrpbench_worlds_standard.building.lanes import LevelDrawing
from mrpbench_worlds_standard.building.node import Node
from mrpbench_worlds_standard.building.notes import Notes

_ROBOTS = "external_agent"
"""The profile of agents that others move."""
_Places = list[tuple[float, float, int]]
"""x, y, index of the level."""


def read_crowd_sim(
    building: Node, drawings: Sequence[LevelDrawing], notes: Notes
) -> tuple[tuple[Activity, ...], tuple[PeopleGroup, ...]]:
    """Return what people do and how many there are; nothing if the section is absent or not enabled.

    Profiles, capacities and navigation meshes have no effect: crowds have options of their own for radius and speed.

    Raises:
        InputError: the section names a state or a goal set that it does not have, or a value is not of its type.
    """
    top = building.fields().get("crowd_sim")
    if top is None or not top.fields() or not top.fields().get("enable", top).value:
        return (), ()
    states = {state.fields()["name"].text(): state for state in _with(top, "states", "name")}
    places_of_group = _places(drawings)
    sets = {
        entry.fields()["set_id"].integer(): [
            place for area in entry.section("set_area") for place in places_of_group.get(area.text(), [])
        ]
        for entry in _with(top, "goal_sets", "set_id")
    }
    usable: dict[str, _Places] = {}
    for name, state in states.items():
        number = state.fields().get("goal_set")
        key = -1 if number is None else number.integer()
        if number is not None and key not in sets and key != -1:
            raise number.error(f"state {name!r} names goal set {key}, which `goal_sets` does not have")
        if key != -1 and not sets[key]:
            notes.add(f"crowd_sim state {name!r} has no places on the loaded levels and is left out")
        else:
            usable[name] = sets[key] if key != -1 else []
    index = {name: number for number, name in enumerate(usable)}
    activities = [
        Activity(
            name=name,
            places=np.array([place[:2] for place in places], float).reshape(-1, 2),
            level=np.array([place[2] for place in places], np.int16),
        )
        for name, places in usable.items()
    ]
    for node in _with(top, "transitions", "from"):
        _check_state(origin := node.fields()["from"], states)
        if (of := index.get(origin.text())) is None:
            continue
        if activities[of].following:
            notes.add(f"crowd_sim has several transitions from {origin.text()!r}: only the first has an effect")
            continue
        activities[of] = _ended(activities[of], node, states, index, notes)
    return tuple(activities), _groups(top, states, index, activities)


def _places(drawings: Sequence[LevelDrawing]) -> dict[str, _Places]:
    """The places of each goal set."""
    places: dict[str, _Places] = defaultdict(list)
    for level, drawing in enumerate(drawings):
        for node, (x, y) in zip(drawing.node.section("vertices"), drawing.positions.tolist(), strict=True):
            items = node.items()
            pair = items[4].fields().get("human_goal_set_name") if len(items) > 4 else None
            if pair is not None:
                places[pair.items()[1].text()].append((x, y, level))
    return places


def _ended(activity: Activity, node: Node, states: dict[str, Node], index: dict[str, int], notes: Notes) -> Activity:
    """The activity with its end, as a transition says."""
    parts = node.fields()
    targets = [(one.fields()["name"], one.fields().get("weight")) for one in _with(node, "Target", "name")]
    if not targets and "to" in parts:
        targets = [(parts["to"], None)]
    for target, _ in targets:
        _check_state(target, states)
    weights = [(target, 1.0 if weight is None else weight.number()) for target, weight in targets]
    if any(weight < 0 for _, weight in weights):
        raise node.error("weights of a transition must not be negative")
    following = tuple((index[target.text()], weight) for target, weight in weights if target.text() in index)
    if not sum(weight for _, weight in following):
        following = ()
    condition = parts.get("Condition")
    kind = "" if condition is None else _type_of(condition)
    if kind in ("and", "or") and condition is not None:
        first, second = (condition.fields().get(f"condition{number}") for number in (1, 2))
        inner = [_condition(part) for part in (first, second) if part is not None]
    else:
        inner = [] if condition is None else [_condition(condition)]
    ends = {key: value for part in inner for key, value in part.items()}
    if not inner or len(ends) < len(inner) or not all(inner):
        notes.add(f"crowd_sim condition of the transition from {activity.name!r} is not supported: it never ends")
        return activity
    return attrs.evolve(activity, **ends, either=kind == "or", following=following)


def _condition(node: Node) -> dict[str, Any]:
    """What a simple condition says of the end of an activity; {} = not supported."""
    parts, kind = node.fields(), _type_of(node)
    if kind == "goal_reached":
        return {"reach": _positive(node, "distance")}
    if kind == "timer":
        spread = parts["dist"].text() if "dist" in parts else "c"
        if spread == "c":
            return {"time": (_positive(node, "value"),) * 2}
        if spread == "u":
            low, high = _positive(node, "min"), _positive(node, "max")
            if low > high:
                raise parts["max"].error(f"max should be at least min, {low:g}")
            return {"time": (low, high)}
    return {}


def _type_of(node: Node) -> str:
    return node.fields()["type"].text() if "type" in node.fields() else ""


def _positive(node: Node, key: str) -> float:
    value = node.fields().get(key)
    if value is None:
        raise node.error(f"has no {key}")
    if value.number() < 0:
        raise value.error(f"{key} must not be negative")
    return value.number()


def _groups(
    top: Node, states: dict[str, Node], index: dict[str, int], activities: Sequence[Activity]
) -> tuple[PeopleGroup, ...]:
    groups = []
    for node in _with(top, "agent_groups", "state_selector"):
        parts = node.fields()
        _check_state(state := parts["state_selector"], states)
        if ("profile_selector" in parts and parts["profile_selector"].text() == _ROBOTS) or state.text() not in index:
            continue
        count = int(_positive(node, "agents_number"))
        x, y = (parts[key].number() if key in parts else 0.0 for key in ("x", "y"))
        activity = index[state.text()]
        level = _level(activities, activity)
        groups.append(PeopleGroup(people=count, x=x, y=y, level=level, activity=activity))
    return tuple(groups)


def _level(activities: Sequence[Activity], first: int) -> int:
    """The level of the first places to which people come who begin with an activity; 0 if they come to none."""
    known, queue = {first}, [first]
    for number in queue:
        if len(activities[number].level):
            return int(activities[number].level[0])
        new = [other for other, _ in activities[number].following if other not in known]
        known.update(new)
        queue += new
    return 0


def _with(node: Node, section: str, key: str) -> list[Node]:
    """The mappings of a section, each of which has this key."""
    entries = node.section(section)
    for entry in entries:
        if key not in entry.fields():
            raise entry.error(f"an entry of {section} has no {key}")
    return entries


def _check_state(node: Node, states: dict[str, Node]) -> None:
    if node.text() not in states:
        raise node.error(f"no state {node.text()!r} in `states`", f"states: {', '.join(states)}")
