import gzip

import numpy as np
import pytest
from mrpbench_crowds_scripted.dynabarn import DynaBarnObstacles
from mrpbench_worlds_standard.barn_task import BarnTask
from mrpbench_worlds_standard.dynabarn import DynaBarn

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.fleet import Fleet

WORLDS = "world,class,index\n0,easy,1\n0,hard,1\n2,easy,1\n"
FRAMES = "class,index,t,x,y\neasy,1,0,0,0\neasy,1,4,4,0\nhard,1,0,5,5\nhard,1,2,5,7\nhard,1,4,5,5\n"


def begun(folder, index=0, worlds=WORLDS, frames=FRAMES):
    (folder / "w.csv").write_text(worlds)
    (folder / "k.csv.gz").write_bytes(gzip.compress(frames.encode()))
    crowd = DynaBarnObstacles(worlds=folder / "w.csv", keyframes=folder / "k.csv.gz", index=index)
    return crowd.start(DynaBarn().load(), Fleet(robots=()), 0, None)


def test_obstacles_of_a_world_follow_their_keyframes_and_begin_again_at_the_first(tmp_path):
    session = begun(tmp_path)
    assert [member.radius for member in session.members] == [0.5, 0.5]
    places = [session.step(0.5, None).pose[:, :2] for _ in range(18)]
    assert places[5] == pytest.approx(np.array([(3.0, 0.0), (5.0, 6.0)]))
    assert places[8] == pytest.approx(np.array([(0.5, 0.0), (5.0, 5.5)]))


def test_a_jump_back_is_no_motion(tmp_path):
    session = begun(tmp_path)
    speed = [np.hypot(*session.step(0.5, None).velocity[0]) for _ in range(18)]
    assert max(speed) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"index": 7}, "has no world 7"),
        ({"worlds": "world,class\n0,easy\n"}, "has no column index"),
        ({"frames": "class,index,t,x,y\neasy,1,0,0,0\n"}, "has no obstacle hard 1"),
        ({"frames": FRAMES.replace("4,0", "four,0")}, "t, x and y must be numbers"),
        ({"frames": FRAMES.replace("4,4,0", "-1,4,0")}, "obstacle easy 1"),
    ],
)
def test_faulty_tables_are_refused_with_their_place(tmp_path, given, message):
    with pytest.raises(InputError, match=message):
        begun(tmp_path, **given)


def test_the_task_leads_west_through_the_square():
    world = DynaBarn().load()
    scenario = BarnTask().draw(world, None, Fleet(robots=()), 0)
    assert scenario.start.tolist() == [[11.0, 0.0, np.pi]]
    assert scenario.tasks[0].goals[0, :2].tolist() == [-9.0, 0.0]


def test_all_tracks_of_the_challenge_keep_the_speeds_of_their_class(shared_data):
    folder = shared_data / "barn"
    files = {"worlds": folder / "dynabarn_worlds.csv", "keyframes": folder / "dynabarn_keyframes.csv.gz"}
    session = DynaBarnObstacles(index=0, **files).start(DynaBarn().load(), Fleet(robots=()), 0, None)
    assert 5 <= len(session.members) <= 24
    fastest = max(np.hypot(*session.step(0.1, None).velocity.T).max() for _ in range(900))
    assert fastest <= 2.0
