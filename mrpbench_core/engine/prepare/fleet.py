"""The fleet of a run: robot models by name or file, shared out over the scenario's robots."""

from collections.abc import Sequence

import attrs

from mrpbench_core.config.settings import FleetEntry
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet, Lidar, RobotModel


def build_fleet(entries: Sequence[FleetEntry], size: int) -> Fleet:
    """Robots in the order of the entries; entries without a count share what the others leave, as evenly as can be.

    Raises:
        InputError: unknown robot, or counts that do not add up to `size`.
    """
    rest = size - sum(entry.count or 0 for entry in entries)
    sharing = sum(entry.count is None for entry in entries)
    if rest < 0 or (rest > 0 and not sharing):
        raise InputError(f"fleet: the counts add up to {size - rest}, the scenario has {size} robots")
    robots: list[RobotModel] = []
    for entry in entries:
        count = entry.count
        if count is None:
            count = -(-rest // sharing)
            rest, sharing = rest - count, sharing - 1
        robots += [robot_model(entry)] * count
    return Fleet(robots=tuple(robots))


def robot_model(entry: FleetEntry) -> RobotModel:
    """The model that an entry names, with its changes to the lidar."""
    model = load_robot(str(entry.robot))
    if entry.graph is not None:
        model = attrs.evolve(model, graph=entry.graph)
    if entry.lidar is None:
        return model
    if entry.lidar == "none":
        return attrs.evolve(model, lidar=None)
    changes = {name: value for name, value in attrs.asdict(entry.lidar).items() if value is not None}
    lidar = attrs.evolve(model.lidar or Lidar(), **changes)
    if lidar.min_range >= lidar.range:
        reach = f"min_range {lidar.min_range:g} m is not below its range {lidar.range:g} m"
        raise InputError(f"fleet: the lidar of {model.name}: {reach}")
    return attrs.evolve(model, lidar=lidar)
