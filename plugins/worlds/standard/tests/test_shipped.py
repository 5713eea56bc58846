import numpy as np
import pytest
from mrpbench_world.facts import check_world, size
from mrpbench_worlds_standard.shipped import (
    CASES,
    ENCOUNTERS,
    Airport,
    Bottlenecks,
    Encounters,
    HospitalCorridor,
    Household,
    Office,
    OfficeNoon,
    Station,
    Warehouse,
    WarehousePickers,
)

from mrpbench_core.builtin.roadmaps.graph import Graph
from mrpbench_core.builtin.roadmaps.grid import GridRoadmap
from mrpbench_core.builtin.roadmaps.lanes import Lanes
from mrpbench_core.checking.clearance import has_clearance
from mrpbench_core.checking.components import components
from mrpbench_core.files.robot import load_robot
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.testing.fixtures.office import office

BURGERS = Fleet(robots=(load_robot("turtlebot3_burger"),) * 2)


NARROW = [Household(), *(Bottlenecks(case=case) for case in CASES)]
ROOMY = [Office(), Warehouse(), Airport()]
PEOPLED = [Station(), OfficeNoon(), WarehousePickers(), *(Encounters(case=case) for case in ENCOUNTERS)]
INHABITED = [(OfficeNoon(), 0), (WarehousePickers(), 0), (HospitalCorridor(), 0), (HospitalCorridor(), 1)]


@pytest.fixture(params=[*ROOMY, *NARROW, *PEOPLED], ids=repr, scope="module")
def world(request):
    return request.param.load()


def test_the_worlds_are_as_large_as_the_papers():
    assert size(Office().load()) == pytest.approx((21.5, 12.0))
    assert size(Warehouse().load()) == pytest.approx((22.0, 27.0))
    assert size(Airport().load()) == pytest.approx((282.22, 64.35), rel=0.01)


def test_the_worlds_have_as_many_places_and_lanes_as_the_papers():
    assert [(len(world.vertices), len(world.lanes)) for world in (source.load() for source in ROOMY)] == [
        (29, 32),
        (54, 59),
        (210, 211),
    ]


def test_everything_in_them_is_understood_and_every_place_has_a_name_of_its_own(world):
    assert world.notes == ()
    names = [vertex.name for vertex in world.vertices]
    assert all(names)
    assert len(set(names)) == len(names)


def test_places_and_lanes_keep_clear_of_walls(world):
    point = np.array([(vertex.x, vertex.y) for vertex in world.vertices])
    lane = np.array([(lane.start, lane.end) for lane in world.lanes])
    assert has_clearance(world.levels[0], point, point, 0.3).all()
    assert has_clearance(world.levels[0], point[lane[:, 0]], point[lane[:, 1]], 0.3).all()


def test_their_doors_and_furniture_are_there():
    flat = Household().load().levels[0]
    assert [door.width - flat.wall_thickness for door in flat.doors] == pytest.approx([0.7] * 6)
    assert len(flat.obstacles) == 28
    assert [door.name for door in Bottlenecks(case="door").load().levels[0].doors] == ["narrow_door"]
    assert len(Airport().load().levels[0].obstacles) > 300


def test_the_cases_are_as_narrow_as_they_say():
    """Two robots side by side fit nowhere on the lane that is the bottleneck; one does."""
    for case, (a, b) in {
        "corridor": ((2.8, 1.2), (7.2, 1.2)),
        "alcove": ((0.4, 0.8), (2.8, 0.8)),
        "door": ((2.8, 1.2), (2.8, 1.2)),
        "roundabout": ((3.6, 1.3), (3.6, 1.9)),
    }.items():
        level = Bottlenecks(case=case).load().levels[0]
        ends = np.array([a]), np.array([b])
        assert has_clearance(level, *ends, 0.349).all(), case
        assert not has_clearance(level, *ends, 0.36).any(), case


ROADMAPS = [
    *(kind(cell_size=size) for kind in (Lanes, GridRoadmap) for size in (0.35, 0.4)),
    Lanes(cell_size=0.35, compatible="mrp_bench"),
    Lanes(cell_size=0.4, compatible="mrp_bench"),
    Graph(),
]


def test_every_place_can_be_reached_from_every_other(world):
    for roadmap in ROADMAPS:
        built = roadmap.build(world, BURGERS)
        assert (built.place >= 0).all(), roadmap
        assert len(set(built.place.tolist())) == len(world.vertices), f"{roadmap}: two places share a vertex"
        assert len(set(components(len(built.position), built.edges))) == 1, roadmap


def test_nothing_is_wrong_with_them(world):
    for roadmap in (Lanes(), GridRoadmap(), Graph()):
        assert check_world(world, roadmap.build(world, BURGERS), 0.125).faults == ()


@pytest.mark.parametrize("source", ROOMY, ids=repr)
def test_nothing_is_left_out_of_the_roadmaps_of_roomy_worlds(source):
    for roadmap in (Lanes(), GridRoadmap(), Graph()):
        assert roadmap.build(source.load(), BURGERS).notes == ()


@pytest.mark.parametrize(("source", "paper"), [(Office, 333), (Warehouse, 788), (Airport, 7645)])
def test_roads_have_about_as_many_cells_as_the_papers(source, paper):
    built = Lanes(cell_size=0.4, compatible="mrp_bench").build(source().load(), BURGERS)
    assert len(built.position) == pytest.approx(paper, rel=0.2)


def test_the_hospital_corridor_is_one_graph_over_two_floors():
    hospital = HospitalCorridor().load()
    built = Graph().build(hospital, BURGERS)
    assert (hospital.notes, built.notes) == ((), ())
    assert (len(hospital.vertices), [len(level.doors) for level in hospital.levels]) == (46, [7, 7])
    assert len(set(components(len(built.position), built.edges))) == 1
    assert check_world(hospital, built, 0.125).faults == ()


@pytest.mark.parametrize(("source", "level"), INHABITED, ids=repr)
def test_people_of_a_level_come_to_all_that_happens_there_and_stay_there(source, level):
    world = source.load()
    known = {group.activity for group in world.people if group.level == level}
    assert sum(group.people for group in world.people if group.level == level) >= 8
    queue = [*known]
    for number in queue:
        activity = world.activities[number]
        assert activity.following
        assert (activity.level == level).all()
        place = activity.places
        assert has_clearance(world.levels[level], place, place, 0.25).all(), activity.name
        new = {other for other, _ in activity.following} - known
        known |= new
        queue += new
    assert len(known) >= 10
    assert len(known) in (len(world.activities), len(world.activities) // 2)


def test_the_conformance_kit_has_the_same_office():
    """To write it again: `json.dumps(encode(Office().load(), inlined), indent=0)`."""
    assert office() == Office().load()
