"""Crowds in the engine: numbered through, seen by one another, recorded, and in charge of doors that they want open."""

import attrs
import numpy as np
import pytest
from mrpbench_crowds_scripted.scripted import Scripted, Track

from mrpbench_core.api import Crowd, CrowdSession, Mover, Movers
from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.execution.crowds import Crowds
from mrpbench_core.engine.run import execute
from mrpbench_core.engine.seeds import Seeds
from mrpbench_core.model.execution.state import Inputs, State
from mrpbench_core.store.paths import RunPaths
from mrpbench_core.store.recording import Recording
from mrpbench_core.testing.fixtures.building import building
from mrpbench_core.testing.fixtures.room import PERIOD, fleet, room

STATE = State(pose=np.zeros((1, 3)), twist=np.zeros((1, 2)), level=[0], contacts=[], facilities={"door": 0.0})
ONE, TWO = (
    Scripted(tracks=(Track(keyframes=((0.0, 1.0, y), (9.0, 3.0, y))),), radius=radius, legs=False)
    for y, radius in ((1.0, 0.2), (2.0, 0.4))
)


@attrs.frozen(kw_only=True)
class Asking(Crowd):
    """One mover that stands, says which doors it wants, and remembers what it saw."""

    doors: tuple[str, ...] = ()
    place: float = 1.0
    speed: float = 0.0
    arrivals: tuple[int, int] = (0, 0)
    mover: Mover = Mover(radius=0.1)

    def start(self, world, fleet, seed, seen):
        return AskingSession(self)


class AskingSession(CrowdSession):
    def __init__(self, options):
        self.options, self.seen, self.members = options, [], (options.mover,)

    @property
    def movers(self):
        place = self.options.place + self.options.speed * PERIOD * len(self.seen)
        arrivals = [self.options.arrivals[bool(self.seen)]]
        return Movers(pose=[[place, 1.0, 0.0]], velocity=[[0.0, 0.0]], level=[0], arrivals=arrivals)

    def step(self, dt, seen):
        self.seen.append(seen)
        return self.movers

    def wanted_doors(self):
        return set(self.options.doors) if not self.seen else set()


def start(*crowds, world=None, apart=False):
    poses, levels = np.array([(1.0, 1.0, 0.0)]), np.zeros(1, np.int16)
    return Crowds(crowds, world or room(), fleet(1), PERIOD, Seeds(0), poses=poses, levels=levels, apart=apart)


@attrs.frozen(kw_only=True)
class Looking(Asking):
    """Remembers what it saw when it began."""

    saw: list = attrs.field(factory=list)

    def start(self, world, fleet, seed, seen):
        self.saw.append(seen)
        return AskingSession(self)


def test_a_member_that_is_put_elsewhere_may_push_a_robot_out_of_its_disc():
    walks, jumps, leaps = (start(Asking(speed=metres / PERIOD)) for metres in (4.9 * PERIOD, 0.9, 1.1))
    for crowds in (walks, jumps, leaps):
        assert crowds.push == 0.0
        crowds.step(STATE)
    assert walks.push == 0.0
    assert jumps.push == pytest.approx(0.9 + 0.1 + fleet(1).robots[0].radius)
    assert leaps.push == pytest.approx(0.1 + fleet(1).robots[0].radius)


def test_a_crowd_sees_where_robots_and_the_crowds_before_it_begin():
    looking = Looking()
    start(ONE, looking, TWO)
    (seen,) = looking.saw
    assert seen.state.pose.tolist() == [[1.0, 1.0, 0.0]]
    assert len(seen.others.pose) == len(seen.radius) == 1


def test_members_are_numbered_through_and_see_the_other_crowds_which_move_in_turn():
    crowds = start(ONE, Asking(), TWO)
    assert [member.radius for member in crowds.members] == [0.2, 0.1, 0.4]
    for _ in range(2):
        crowds.step(STATE)
    assert crowds.movers.pose[:, 0].tolist() == pytest.approx([1 + 2 * 2 / 180, 1, 1 + 2 * 2 / 180])
    seen = crowds._sessions[1].seen
    assert [view.others.pose[:, 0].tolist() for view in seen] == [
        pytest.approx([1 + 2 / 180, 1]),
        pytest.approx([1 + 4 / 180, 1 + 2 / 180]),
    ]
    assert seen[0].radius.tolist() == [0.2, 0.4]


def test_doors_open_while_members_want_them_and_close_again():
    crowds = start(Asking(doors=("door",)), world=building())
    assert crowds.doors(STATE, {"lift": 2.0, "door": 0.0}) == {"lift": 2.0, "door": 1.0}
    crowds.step(STATE)
    assert crowds.doors(STATE, {}) == {"door": 0.0}
    assert crowds.doors(STATE, {"door": 1.0}) == {"door": 1.0}  # a robot wants it
    assert crowds.doors(attrs.evolve(STATE, facilities={}), {}) == {}  # the simulator has none


@pytest.mark.parametrize(
    ("crowd", "said"),
    [
        (Asking(place=np.nan), "not finite"),
        (Asking(place=1e10), "too large"),
        (Asking(doors=("gate",)), "gate"),
        (Asking(arrivals=(-2, 0)), "arrivals that are not"),
        (Asking(arrivals=(2, 1)), "fewer goals that a member has reached"),
        (Asking(mover=Mover(radius=np.inf)), "the member Mover"),
        (Asking(mover=Mover(radius="0.1")), "the member Mover"),
        (Asking(mover=Mover(radius=0.1, leg_radius=np.inf)), "the member Mover"),
        (Asking(mover=Mover(radius=0.1, kind=b"person")), "the member Mover"),
        (Asking(mover=Mover(radius=0.1, kind=65 * "x")), "the member Mover"),
    ],
)
def test_what_a_crowd_must_not_return_is_refused(crowd, said):
    def use():
        crowds = start(crowd, world=building())
        crowds.doors(STATE, {})
        crowds.step(STATE)

    with pytest.raises(BrokenContractError, match=said):
        use()


@pytest.mark.parametrize("speed", [5.0, 1.1 / PERIOD])
def test_members_may_run_or_be_put_elsewhere(speed):
    start(Asking(speed=speed)).step(STATE)


def test_crowds_apart_see_no_robots_and_simulators_none_of_their_members():
    crowds = start(ONE, Asking(), apart=True)
    crowds.step(STATE)
    (seen,) = crowds._sessions[1].seen
    assert seen.state.level.tolist() == [-1]
    assert seen.others.level.tolist() == [0]
    given = crowds.inputs(Inputs(twist=[[0, 0]]))
    assert given.mover_level.tolist() == [-1, -1]
    assert np.isinf(given.movers[:, :2]).all()
    assert crowds.movers.level.tolist() == [0, 0]


def test_absent_members_are_nowhere_for_the_simulator(tmp_path):
    (tmp_path / "tracks.csv").write_text("id,t,x,y\na,1,1,1\na,2,2,1\n")
    crowds = start(Scripted(file=tmp_path / "tracks.csv"))
    given = crowds.inputs(Inputs(twist=[[0, 0]]))
    assert np.isinf(given.movers[0, :2]).all()
    assert np.isinf(given.legs[0, :4]).all()


HALL = """
name: hall
coordinate_system: cartesian_meters
levels:
  L1:
    vertices: [[0, 0, 0, ""], [8, 0, 0, ""], [8, 4, 0, ""], [0, 4, 0, ""], [1, 2, 0, west], [7, 2, 0, east]]
    walls: [[0, 1], [1, 2], [2, 3], [3, 0]]
    lanes: [[4, 5, {bidirectional: [4, true]}]]
"""


CART = {"plugin": "scripted", "tracks": [{"keyframes": [[0, 4, 2]]}], "kind": "cart", "legs": False}
PERSON = {"plugin": "scripted", "tracks": [{"keyframes": [[0, 2, 3], [10, 6, 3]], "loop": True}]}


def drive(tmp_path, **settings):
    """The record and the recording of a robot that drives through the hall."""
    pytest.importorskip("mrpbench_planners_mapf")
    (tmp_path / "hall.building.yaml").write_text(HALL)
    study = {
        "world": {"plugin": "rmf", "file": str(tmp_path / "hall.building.yaml")},
        "roadmap": "graph",
        "scenario": {"plugin": "named", "starts": ["west"], "goals": ["east"]},
        "assigner": "identity",
        "planner": "prioritized",
        "control_rate": "10 Hz",
        "limits": {"execution": "20 s"},
        "metrics": ["execution"],
    }
    (point,) = load_study(study | settings).runs
    paths = RunPaths(recording=tmp_path / "run.zip", exports=tmp_path / "exports")
    record = execute(point.config, point.run_id, paths, lambda stage, facts: None).message()
    return record, Recording(tmp_path / "run.zip")


def test_movers_are_recorded_and_touches_name_them(tmp_path):
    record, recording = drive(tmp_path, crowds=[PERSON, CART])
    mover, contact = recording.channel("mover"), recording.channel("contact")
    assert mover[:, 1, :2].tolist() == [[4, 2]] * len(mover)
    assert mover[50, 0, [0, 3]] == pytest.approx([4.0, 0.4])  # 5 s after the start
    assert recording.channel("mover_level").shape == (len(mover), 2)
    assert recording.context().mover_names == ("person_0", "cart_1")
    assert set(map(tuple, contact.tolist())) == {(0, 2)}
    assert recording.channel("event_detail")[recording.channel("event_kind") == "contact"][0] == "mover_1"
    arrivals = recording.channel("mover_arrivals")
    recording.close()
    assert (arrivals == -1).all()
    assert record["metrics"]["execution.wall_contacts"] == record["metrics"]["execution.robot_contacts"] == 0


def test_robots_apart_from_crowds_drive_as_without_them(tmp_path):
    _, alone = drive(tmp_path)
    truth = alone.channel("truth")
    alone.close()
    _, apart = drive(tmp_path, crowds=CART, crowds_apart=True)
    assert np.array_equal(apart.channel("truth"), truth)
    assert not len(apart.channel("contact"))
    assert (apart.channel("mover_level") == 0).all()
    apart.close()
