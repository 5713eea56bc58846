"""Problems on a given roadmap, and those of the MovingAI benchmark."""

from collections.abc import Iterable, Sequence
from pathlib import Path as File
from typing import Any

from numpy.typing import ArrayLike

from mrpbench_core.model.planning.problem import Feature, Problem, Rules
from mrpbench_core.model.planning.roadmap import Roadmap
from mrpbench_core.testing.drawing import build
from mrpbench_tests.instances.roadmaps import grid_of, roadmap


def problem_on(
    road: Roadmap,
    starts: Iterable[int],
    goals: Iterable[int | Sequence[int]],
    *,
    radius: ArrayLike | None = None,
    following: str = "allowed",
    at_goal: str = "stay",
    **fields: Any,
) -> Problem:
    """Robots on a roadmap, each with a goal or several to choose from; with a `radius`, footprints count."""
    return build(
        road,
        starts,
        [(goal,) if isinstance(goal, int) else tuple(goal) for goal in goals],
        radius=0.0 if radius is None else radius,
        features=() if radius is None else (Feature.FOOTPRINTS,),
        rules=Rules(following=following, at_goal=at_goal),
        **fields,
    )


def endless_swap(vertices: int) -> Problem:
    """Two robots that swap the ends of a path: no plan, and no quick proof of that, since moves take two ticks."""
    road = grid_of(["." * vertices])
    return problem_on(roadmap(road.position, road.edges, 2), [0, vertices - 1], [vertices - 1, 0])


def movingai(data: File, name: str, scen: str, robots: int) -> Problem:
    """The first `robots` tasks of a scenario of the MovingAI benchmark, from `data`/movingai."""
    lines = (data / "movingai" / "maps" / f"{name}.map").read_text().splitlines()[4:]
    road = grid_of(["".join("." if cell in ".G" else "#" for cell in line) for line in lines])
    index = {(int(x), int(-y)): vertex for vertex, (x, y) in enumerate(road.position)}
    table = (data / "movingai" / "scens" / f"{name}-{scen}.scen").read_text().splitlines()[1 : robots + 1]
    tasks = [[int(value) for value in line.split()[4:8]] for line in table]
    assert len(tasks) == robots
    return problem_on(road, [index[x, y] for x, y, _, _ in tasks], [index[x, y] for _, _, x, y in tasks])
