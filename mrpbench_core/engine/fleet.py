"""The fleet of a run: robot models by name or file, shared out over the scenario's robots."""

from itertools import cycle

from mrpbench_core.config.settings import RunConfig
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.fleet import Fleet, RobotModel


def build_fleet(config: RunConfig, size: int) -> Fleet:
    """Robots in the order of the entries: those with a count first in their place, the others take turns for the rest.

    Raises:
        InputError: unknown robot, no robots, or counts that do not add up to `size`.
    """
    if size < 1:
        raise InputError("scenario: needs at least one robot")
    fixed = sum(entry.count or 0 for entry in config.fleet)
    open_entries = [entry for entry in config.fleet if entry.count is None]
    if fixed > size or (fixed < size and not open_entries):
        raise InputError(f"fleet: the counts add up to {fixed}, the scenario has {size} robots")
    models = {entry: _model(entry) for entry in config.fleet}
    rest: dict[object, list[RobotModel]] = {entry: [] for entry in open_entries}
    for _, entry in zip(range(size - fixed), cycle(open_entries or [None]), strict=False):
        rest[entry].append(models[entry])
    robots: list[RobotModel] = []
    for entry in config.fleet:
        robots += rest[entry] if entry.count is None else [models[entry]] * entry.count
    return Fleet(robots=tuple(robots))
