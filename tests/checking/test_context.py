"""A sound context has no fault; each kind of contradiction is found and named."""

import attrs
import numpy as np
import pytest

from mrpbench_core.checking.context import check_context, check_rows
from mrpbench_core.model.planning.plan import RobotPath
from mrpbench_core.model.planning.roadmap import Raster, Resource
from mrpbench_core.model.worlds.world import Door, Lane, Lift, Vertex


def test_a_sound_context_has_no_fault(run_context):
    assert check_context(run_context) is None


def evolved(context, steps, value):
    """The context with one value replaced, by the names of fields and the indices on the way to it."""
    step, *rest = steps
    if isinstance(step, int):
        entries = list(context)
        entries[step] = evolved(entries[step], rest, value) if rest else value
        return tuple(entries)
    return attrs.evolve(context, **{step: evolved(getattr(context, step), rest, value) if rest else value})


DOOR = Door(name="d", start=(0, 0), end=(1, 0))
LIFT = Lift(name="l", x=0, y=0, yaw=0, width=1, depth=1, levels=(0,), initial_level=0)


@pytest.mark.parametrize(
    ("steps", "value", "fault"),
    [
        ("period", 0.0, "period is not positive"),
        ("period", float("nan"), "period is nan"),
        ("goal", ((0.0, 0.0, 0.0),), "goal has the shape (1,) instead of 2 entries"),
        ("assigned", (0, 9), "assigned does not exist"),
        ("world levels", (), "world has no level"),
        ("world levels 0 elevation", 1e12, "elevation is 1e+12"),
        ("world levels 0 walls", [[0, 0, np.nan, 1]], "walls is not finite"),
        ("world levels 0 doors", (attrs.evolve(DOOR, end=(0, 0)),), "a door has no width"),
        ("world vertices 0 level", 3, "a place: its level does not exist"),
        ("world lanes", (Lane(start=0, end=9),), "a lane: its end does not exist"),
        ("world lifts", (attrs.evolve(LIFT, levels=(4,)),), "a lift: a level does not exist"),
        ("world lifts", (attrs.evolve(LIFT, initial_level=1),), "a lift begins at a level that it does not serve"),
        ("fleet robots 0 footprint", [[0, 0]], "a footprint has less than three corners"),
        ("fleet robots 0 max_speed", -1.0, "max_speed is -1"),
        ("fleet robots 0 lidar beams", 0, "a lidar has no beams"),
        ("scenario start_level", [0, 7], "scenario.start_level does not exist"),
        ("scenario start", [[np.inf, 0, 0]] * 2, "scenario.start is not finite"),
        ("problem start", [[0], [1]], "problem.start has the shape (2, 1) instead of 2 entries"),
        ("problem start", [0, 3], "problem.start does not exist"),
        ("problem ready", [0, -(2**63)], "problem.ready is too far from 0"),
        ("problem radius", [0.2, -0.2], "problem.radius is negative"),
        ("problem profile", [0, 1], "problem.profile does not exist"),
        ("problem goals", (((5,),), ()), "problem.goals does not exist"),
        ("problem roadmap edges", [[0, 5]], "roadmap.edges does not exist"),
        ("problem roadmap duration", [[1]], "roadmap.duration has another number of edges"),
        ("problem roadmap tick", 0.0, "roadmap.tick is not positive"),
        ("problem roadmap resources", (Resource(name="r", kind="door", edges=(9,)),), "a resource: an edge"),
        ("problem roadmap grid", Raster(shape=(1, 2), cell_size=1.0, origin=(0.0, 0.0), cell=[[0, 0], [0, 1], [0, 2]]),
         "roadmap.grid.cell does not exist"),
        ("result plan paths 0", RobotPath(edge=[8], enter=[0], leave=[1]), "result.plan: an edge does not exist"),
        ("result plan paths 0", RobotPath(edge=[0], enter=[0, 1], leave=[1]), "different numbers of edges and ticks"),
        ("result plan paths 0", RobotPath(edge=[0], enter=[2], leave=[1]), "result.plan: the ticks of a path decrease"),
        ("routes 0 speed", [1.0] * 9, "routes: the numbers of waypoints, levels and speeds do not agree"),
    ],
)  # fmt: skip
def test_a_contradiction_is_named(run_context, steps, value, fault):
    world = attrs.evolve(run_context.world, vertices=(Vertex(name="v", x=0.0, y=0.0),), lifts=(LIFT,))
    context = attrs.evolve(run_context, world=world)
    assert check_context(context) is None
    found = check_context(evolved(context, [int(s) if s.isdigit() else s for s in steps.split()], value))
    assert found is not None
    assert fault in found


def test_rows_of_a_channel_refer_to_what_the_context_has(run_context):
    time = np.arange(2.0)
    assert check_rows("mode", np.zeros((2, 2), "u1"), time, run_context) is None
    assert check_rows("mode", np.full((2, 2), 5, "u1"), time, run_context) == "mode does not exist"
    assert check_rows("waits_for", np.zeros((2, 2), "i4"), time, run_context) == "waits_for does not exist"
    assert check_rows("facility", np.zeros((2, 1)), time, run_context) == "facility has 1 columns instead of 0"
    assert check_rows("acme/own", np.array("any"), time, run_context) is None
