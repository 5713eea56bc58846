import numpy as np
import pytest
from mrpbench_crowds_scripted.scripted import Scripted, Track

from mrpbench_core.api import CrowdView, Movers
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution.state import State
from mrpbench_core.testing import CrowdConformance
from mrpbench_core.testing.fixtures.room import fleet, room

STATE = State(pose=np.empty((0, 3)), twist=np.empty((0, 2)), level=np.empty(0, "i2"), contacts=np.empty((0, 2), "i4"))
NOBODY = Movers(pose=np.empty((0, 3)), velocity=np.empty((0, 2)), level=np.empty(0, "i2"))
VIEW = CrowdView(state=STATE, others=NOBODY, radius=np.empty(0))
ACROSS = ((1.0, 1.0, 2.0), (3.0, 2.0, 2.0), (4.0, 2.0, 1.0))


class TestScripted(CrowdConformance):
    def make(self):
        return Scripted(tracks=(Track(keyframes=ACROSS, loop=True), Track(keyframes=((0.0, 3.0, 1.0),))))


def places(crowd, seconds, dt=0.5):
    session = crowd.start(room(), fleet(1), 0, VIEW)
    return [session.movers, *(session.step(dt, VIEW) for _ in range(round(seconds / dt)))]


def test_a_track_waits_goes_straight_and_stays():
    found = np.array([movers.pose[0] for movers in places(Scripted(tracks=(Track(keyframes=ACROSS),)), 5)])
    assert found[[0, 2, 4, 6, 8, 10], :2].tolist() == [[1, 2], [1, 2], [1.5, 2], [2, 2], [2, 1], [2, 1]]
    assert np.allclose(found[[0, 6, 8, 10], 2], [0, 0, -np.pi / 2, -np.pi / 2])


def test_a_loop_returns_as_fast_as_it_went_and_begins_again():
    track = Track(keyframes=((0.0, 1.0, 1.0), (2.0, 3.0, 1.0)), loop=True)
    found = [movers.pose[0, 0] for movers in places(Scripted(tracks=(track,)), 6, 1.0)]
    assert np.allclose(found, [1, 2, 3, 2, 1, 2, 3])


def test_recorded_people_are_there_while_they_were_observed(tmp_path):
    file = tmp_path / "tracks.csv"
    file.write_text("t,id,x,y\n1,ann,1,1\n0,bob,2,2\n2,ann,2,1\n3,bob,2,1\n")
    found = places(Scripted(file=file), 4, 1.0)
    assert [movers.level.tolist() for movers in found] == [[-1, 0], [0, 0], [0, 0], [-1, 0], [-1, -1]]
    assert found[2].pose[:, :2].tolist() == [[2, 1], [2, pytest.approx(4 / 3)]]


@pytest.mark.parametrize(
    ("text", "said"),
    [("id,t,x\na,0,1\n", "no column y"), ("id,t,x,y\na,0,1,z\n", "must be numbers"),
     ("id,t,x,y\na,0,1,1\na,0,2,1\n", "must increase"), ("id,t,x,y\na,0,0.1,1\n", "touches something solid")],
)  # fmt: skip
def test_a_bad_file_is_named_with_its_fault(tmp_path, text, said):
    file = tmp_path / "tracks.csv"
    file.write_text(text)
    with pytest.raises(InputError, match=said) as caught:
        Scripted(file=file).start(room(), fleet(1), 0, VIEW)
    assert "tracks.csv" in str(caught.value)
