"""`mrpbench analyze` on bags, from the command line to the table."""

import json

import numpy as np
import pytest

from mrpbench_core import load, run
from mrpbench_core.cli.main import main
from mrpbench_core.files.scenario import write_scenario
from mrpbench_core.model.planning.scenario import Scenario, Task
from mrpbench_core.store.recording import Recording

NAN = float("nan")
MAP = "type octile\nheight 6\nwidth 12\nmap\n" + "............\n" * 6
STUDY = {
    "name": "simulated",
    "roadmap": "grid",
    "scenario": {"plugin": "random", "robots": 3},
    "assigner": "identity",
    "planner": "example",
    "export": ["rosbag2"],
}
SCENARIO = Scenario(
    start=[[1.0, 1.0, 0.0], [1.0, 2.0, 0.0]],
    start_level=[0, 0],
    tasks=(Task(goals=[[5.0, 1.0, NAN]]), Task(goals=[[3.0, 2.0, NAN], [5.0, 2.0, NAN]], levels=[0, 0])),
)


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """The results folder of a run of ours with a bag, and its record."""
    folder = tmp_path_factory.mktemp("own")
    (folder / "free.map").write_text(MAP)
    world = {"plugin": "movingai", "file": str(folder / "free.map")}
    (record,) = run(STUDY | {"world": world}, out=folder / "simulated")
    return folder / "simulated", record


@pytest.fixture
def analyze(tmp_path, monkeypatch, capsys):
    """Analyses a bag in a folder with a map and a scenario: exit code, record (None on failure) and errors."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "free.map").write_text(MAP)
    write_scenario(tmp_path / "two.yaml", SCENARIO)

    def invoke(bag, *words, known=False):
        place = [] if known else ["--world", "free.map", "--scenario", "two.yaml"]
        code = main(["analyze", str(bag), *place, "--out", "measured", "--json", *map(str, words)])
        said = capsys.readouterr()
        return code, json.loads(said.out) if said.out else None, said.err

    return invoke


def passing(bag, speed=0.5, seconds=10.0, only=("a", "b"), **shift):
    """Two robots drive 4 m side by side, `b` half as fast."""
    for t in np.arange(0, seconds + 0.05, 0.1):
        for index, name in enumerate("ab"):
            if name in only:
                x = 1.0 + min(4.0, speed / (1 + index) * t)
                bag.amcl(f"/{name}/amcl_pose", 1.7e9 + t + shift.get(name, 0.0), x, 1.0 + index, 0.0)
    return bag


def test_a_run_comes_back_with_its_numbers(analyze, own, capsys):
    folder, record = own
    code, found, _ = analyze(folder / "exports" / record["run_id"] / "rosbag2", known=True)
    assert (code, found["status"], found["unmeasured"]) == (0, record["status"], {})
    assert found["scenario_id"] == record["scenario_id"]
    assert found["run_id"] != record["run_id"]
    assert found["metrics"].keys() == record["metrics"].keys()
    for name, value in record["metrics"].items():
        assert found["metrics"][name] == pytest.approx(value, abs=1e-6), name
    assert main(["report", str(folder), "measured"]) == 0
    table = capsys.readouterr().out
    assert "kinematic" in table
    assert "recorded" in table


def test_values_that_no_bag_shows_are_null_with_the_reason(analyze, foreign):
    code, found, _ = analyze(passing(foreign(), seconds=20).close())
    values, reasons = found["metrics"], found["unmeasured"]
    assert (code, found["status"]) == (0, "succeeded")
    assert {name for name in values if name.startswith("planning.") and values[name] is not None} == set()
    null = {name for name, value in values.items() if value is None and not name.startswith("planning.")}
    assert null == {f"execution.{name}" for name in ("time_blocked_s", "time_blocked_max_s")} | {
        "execution.robot_contacts",
        "execution.wall_contacts",
    }
    assert reasons == {
        "planning": "planned by others",
        "execution.time_blocked_s": "no path",
        "execution.time_blocked_max_s": "no path",
        "execution.robot_contacts": "no contact, contact_time",
        "execution.wall_contacts": "no contact, contact_time",
    }


def test_numbers_of_a_foreign_bag_are_those_of_the_driven_paths(analyze, foreign):
    _, found, _ = analyze(passing(foreign(), seconds=20).close())
    values = found["metrics"]
    assert values["execution.goals_reached"] == 2
    assert values["execution.duration_s"] == pytest.approx(15.0)  # 3.75 m at 0.25 m/s
    assert values["execution.distance_m"] == pytest.approx(8.0, abs=1e-6)
    assert values["execution.min_distance_m"] == pytest.approx(1.0, abs=1e-6)
    assert values["execution.mrp_bench.duration_s"] == pytest.approx(13.5 - 1.5, abs=0.51)
    assert found["scenario_id"] == SCENARIO.id
    assert found["analysis"]["sources"] == {name: f"amcl_pose: /{name}/amcl_pose" for name in "ab"}


def stopping(bag, seconds=20.0):
    """Like `passing`, but `b` stops halfway for good."""
    for t in np.arange(0, seconds + 0.05, 0.1):
        bag.amcl("/a/amcl_pose", t, 1.0 + min(4.0, 0.5 * t), 1.0, 0.0)
        bag.amcl("/b/amcl_pose", t, 1.0 + min(2.0, 0.25 * t), 2.0, 0.0)
    return bag


OUTCOME = ("execution.success", "execution.goals_reached", "execution.mrp_bench.success", "execution.duration_s")


def test_a_bag_that_ends_while_a_robot_drives_says_nothing_about_its_goal(analyze, foreign):
    _, found, _ = analyze(passing(foreign(), seconds=12).close())
    reason = "b still moves when the recording ends"
    assert (found["status"], found["error"]["message"]) == ("unknown", reason)
    assert [found["metrics"][name] for name in OUTCOME] == [None] * 4
    assert {found["unmeasured"][name] for name in OUTCOME} == {reason}
    assert found["metrics"]["execution.distance_m"] == pytest.approx(7.0, abs=0.01)
    assert f"how the run ended is unknown: {reason}" in found["analysis"]["notes"]


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("--end-time", "8"), "the rest of the recording is cut off"),
        ((), "the end of the recording is missing or damaged"),
    ],
)
def test_a_bag_cut_short_is_unknown_even_if_its_robots_stand(analyze, foreign, words, reason):
    bag = stopping(foreign()).close()
    if not words:
        (storage,) = bag.glob("*.mcap")
        storage.write_bytes(storage.read_bytes()[:-20])  # as a recorder leaves it that is killed
    _, found, _ = analyze(bag, *words)
    assert found["status"] == "unknown"
    assert reason in found["error"]["message"]


def test_a_bag_cut_short_after_all_arrived_is_a_success(analyze, foreign):
    _, found, _ = analyze(passing(foreign(), seconds=40).close(), "--end-time", "20")
    assert (found["status"], found["metrics"]["execution.goals_reached"]) == ("succeeded", 2)


def test_runs_of_unknown_end_leave_the_success_rate(analyze, foreign, capsys):
    bag = passing(foreign(), seconds=12).close()
    analyze(bag)
    assert main(["analyze", str(bag), "--world", "free.map", "--scenario", "two.yaml", "--out", "measured"]) == 0
    assert "partial: the recording ends early" in capsys.readouterr().out
    assert main(["report", "measured"]) == 0
    table = capsys.readouterr().out
    assert "0/0" in table
    assert "1 unknown" in table


def test_a_goal_at_which_no_robot_is_seen_is_missed(analyze, foreign):
    _, found, _ = analyze(stopping(foreign()).close())
    assert found["status"] == "goals_missed"
    assert found["metrics"]["execution.goals_reached"] == 1
    assert found["metrics"]["execution.duration_s"] is None
    assert "1 of 2 robots" in found["error"]["message"]


def test_robots_that_appear_late_are_held_where_they_appear(analyze, foreign):
    _, found, _ = analyze(passing(foreign(), seconds=20, b=5.0).close())
    notes = found["analysis"]["notes"]
    assert any(note.startswith("a is last seen 5.0 s before the end") for note in notes)
    assert any(note.startswith("b appears 5.0 s late") for note in notes)
    assert found["metrics"]["execution.duration_s"] == pytest.approx(20.0)


def test_robots_that_moved_unseen_have_no_distances(analyze, foreign):
    bag = foreign()
    for t in np.arange(0, 20.05, 0.1):
        x = 1.0 + min(4.0, 0.5 * t)
        if not 3 < t < 6:
            bag.amcl("/a/amcl_pose", t, x, 1.0, 0)
        if not 11 < t < 15:  # stands, as AMCL is silent then
            bag.amcl("/b/amcl_pose", t, x, 2.0, 0)
    code, found, _ = analyze(bag.close())
    assert (code, found["metrics"]["execution.min_distance_m"]) == (0, None)
    assert found["unmeasured"]["execution"] == "a moved 1.50 m unseen from 3.0 to 6.0 s"
    _, found, _ = analyze(bag.path, "--start-time", 6)
    assert found["metrics"]["execution.min_distance_m"] == pytest.approx(1.0)
    _, found, _ = analyze(bag.path, "--max-gap", 4)
    assert found["metrics"]["execution.min_distance_m"] == pytest.approx(1.0)


def triggered(bag, standing=(), names="ab"):
    """AMCL with Nav2's defaults: a pose for every 0.25 m; robots stand in the intervals `standing`."""
    for index, name in enumerate(names):
        x = last = 1.0
        bag.amcl(f"/{name}/amcl_pose", 0.0, x, 1.0 + index, 0.0)
        for t in np.arange(0.1, 40, 0.1):
            if x < 5.0 and not any(since < t < until for since, until in standing):
                x += 0.05
            if x - last >= 0.25 - 1e-9:
                last = x
                bag.amcl(f"/{name}/amcl_pose", t, x, 1.0 + index, 0.0)
    return bag


def test_amcl_that_is_silent_while_a_robot_stands_has_no_gaps(analyze, foreign):
    _, found, _ = analyze(triggered(foreign(), standing=[(3.0, 12.0), (15.0, 20.0)]).close())
    assert found["status"] == "succeeded"
    assert found["metrics"]["execution.min_distance_m"] == pytest.approx(1.0)
    assert found["metrics"]["execution.duration_s"] == pytest.approx(22.0, abs=1.0)
    (note,) = (note for note in found["analysis"]["notes"] if note.startswith("a: "))
    assert "only while the robot moves, at most 0.25 m apart: it is held where it was during 2 gaps" in note


def test_amcl_that_is_silent_near_the_goal_leaves_the_end_unknown(analyze, foreign):
    bag = triggered(foreign(), standing=[(3.0, 6.0)])
    bag.said = [said for said in bag.said if said[0] < 7.8e9]
    _, found, _ = analyze(bag.close(), "--tolerance", "0.1")
    assert found["status"] == "unknown"
    assert "may have moved up to 0.25 m after its last pose" in found["error"]["message"]


@pytest.mark.parametrize("source", ["quaternion", "fleet_states"])
def test_unknown_headings_are_those_of_the_motion_and_noted(analyze, foreign, tmp_path, source):
    bag = foreign()
    for t in np.arange(0, 20.05, 0.1):
        places = {name: (1.0 + min(4.0, 0.5 * t), 1.0 + index, NAN) for index, name in enumerate("ab")}
        if source == "fleet_states":
            bag.fleet(t, places)
            continue
        for name, (x, y, _) in places.items():
            bag.amcl(f"/{name}/amcl_pose", t, x, y, 0.0)
            orientation = bag.said[-1][3].pose.pose.orientation
            orientation.z = orientation.w = 0.0
    _, found, _ = analyze(bag.close())
    assert found["status"] == "succeeded"
    (note,) = (note for note in found["analysis"]["notes"] if note.startswith("a: "))
    assert note.startswith("a: 201 of 201 headings are unknown")
    assert "taken from the direction of motion" in note
    recording = Recording(load(tmp_path / "measured").folder.run(found["run_id"]).recording)
    assert np.allclose(recording.channel("truth")[..., 2], 0.0)
    recording.close()


def test_an_unknown_heading_at_the_start_of_odometry_is_noted(analyze, foreign, tmp_path):
    start = [[1.0, 1.0, NAN], [1.0, 2.0, 0.0]]
    write_scenario(tmp_path / "two.yaml", Scenario(start=start, start_level=[0, 0], tasks=SCENARIO.tasks))
    bag = foreign()
    for t in np.arange(0, 10.05, 0.1):
        for name in "ab":
            bag.odometry(f"/{name}/odom", t, 0.4 * t, 0.0, 0.0)
    _, found, _ = analyze(bag.close())
    said = "a: the heading at the start is unknown, so its frame is taken as parallel to `map`"
    assert said in found["analysis"]["notes"]


def test_poses_inside_walls_are_noted_with_robot_time_and_place(analyze, foreign, tmp_path):
    rows = ["............"] * 6
    rows[-3] = "..@........."  # x from 2 to 3, y from 2 to 3
    (tmp_path / "free.map").write_text(MAP.partition("map\n")[0] + "map\n" + "\n".join(rows) + "\n")
    bag = foreign()
    for t in np.arange(0, 10.05, 0.1):
        for index, name in enumerate("ab"):
            bag.amcl(f"/{name}/amcl_pose", t, 1.0 + 0.5 * t, 1.5 + index, 0.0)
    _, found, _ = analyze(bag.close())
    notes = [note for note in found["analysis"]["notes"] if "inside walls" in note]
    assert [note.partition(":")[0] for note in notes] == [
        "b is inside walls or obstacles for 2.0 s, first at 2.0 s at (2.00, 2.50)"
    ]


def test_nothing_is_called_planned_where_no_plan_is_known(analyze, foreign, capsys, tmp_path, monkeypatch):
    _, found, _ = analyze(passing(foreign(), seconds=20).close())
    assert found["analysis"]["planned"] is False
    assert main(["report", "measured"]) == 0
    out = capsys.readouterr().out
    assert "succeeded" in out
    assert "plans found" not in out
    drawn = []
    monkeypatch.setattr("mrpbench_core.report.pictures.world.plot_paths", lambda *given, **_: drawn.append(given[4]))
    assert main(["view", f"measured:{found['run_id']}", "--png", "it.png"]) == 0
    assert drawn == [False]
    (page,) = tmp_path.glob("measured/replay-*.html")
    assert '"planned": false' in page.read_text() or '"planned":false' in page.read_text()


def test_odometry_of_a_frame_of_its_own_begins_at_the_start(analyze, foreign):
    bag = foreign()
    for t in np.arange(0, 10.05, 0.1):
        bag.odometry("/a/odom", t, 7.0, 3.0 + 0.4 * t, np.pi / 2)  # ahead, wherever that is
        bag.odometry("/b/odom", t, 0.4 * t, 0.0, 0.0)
    _, found, _ = analyze(bag.close())
    assert found["metrics"]["execution.goals_reached"] == 2
    assert found["metrics"]["execution.min_distance_m"] == pytest.approx(1.0)
    assert sum("in no frame of the map" in note for note in found["analysis"]["notes"]) == 2


def test_robots_are_put_in_the_scenarios_order(analyze, foreign):
    bag = passing(foreign(), seconds=20)
    bag.amcl("/visitor/amcl_pose", 1.7e9, 0, 0, 0)
    code, _, error = analyze(bag.close())
    assert code == 2
    assert "the scenario has 2 robots, the recording shows 3: a, b, visitor" in error
    _, found, _ = analyze(bag.path, "--robots", "b,a")
    assert list(found["analysis"]["sources"]) == ["b", "a"]
    assert found["metrics"]["execution.goals_reached"] == 0
    assert not [note for note in found["analysis"]["notes"] if "matched" in note]
    _, found, _ = analyze(bag.path, "--robots", "[ab]")
    assert found["metrics"]["execution.goals_reached"] == 2


def test_a_note_says_that_robots_are_matched_by_index(analyze, foreign):
    _, found, _ = analyze(passing(foreign(), seconds=20).close())
    assert found["analysis"]["notes"] == [
        "robots and tasks of the scenario are matched by index, not by name: a is robot 0, b is robot 1"
    ]


def test_robots_are_matched_by_name_where_the_scenario_names_them(analyze, foreign, tmp_path):
    bag = passing(foreign(), seconds=20)
    bag.amcl("/visitor/amcl_pose", 1.7e9, 0, 0, 0)
    bag.close()
    swapped = Scenario(
        start=SCENARIO.start[::-1], start_level=[0, 0], start_names=("b", "a"), tasks=SCENARIO.tasks[::-1]
    )
    write_scenario(tmp_path / "two.yaml", swapped)
    code, found, _ = analyze(bag.path)
    assert (code, found["metrics"]["execution.goals_reached"]) == (0, 2)
    assert list(found["analysis"]["sources"]) == ["b", "a"]
    assert found["analysis"]["notes"] == ["the scenario names no robot like visitor: left out"]


def test_tasks_are_matched_by_name_where_they_are_named_after_robots(analyze, foreign, tmp_path):
    tasks = (Task(name="b", goals=[[5.0, 2.0, NAN]]), Task(name="a", goals=[[5.0, 1.0, NAN]]))
    scenario = Scenario(start=SCENARIO.start, start_level=[0, 0], tasks=tasks)
    write_scenario(tmp_path / "two.yaml", scenario)
    _, found, _ = analyze(passing(foreign(), seconds=20).close())
    assert (found["status"], found["analysis"]["notes"]) == ("succeeded", [])


def test_the_recording_is_kept_and_analysing_again_is_another_attempt(analyze, foreign, tmp_path):
    bag = passing(foreign(), seconds=20).close()
    _, first, _ = analyze(bag)
    _, again, _ = analyze(bag, "--metrics", "execution")
    assert (again["run_id"], first["attempt"], again["attempt"]) == (first["run_id"], 1, 2)
    assert analyze(bag)[1]["attempt"] == 3
    _, other, _ = analyze(bag, "--rate", 5)
    assert other["run_id"] != first["run_id"]
    results = load(tmp_path / "measured")
    assert len(results) == 2
    assert results.entry(first["run_id"]).attempt == 3
    assert len(list((results.folder.path / "recordings").iterdir())) == 2, "of each run the last attempt"
    recording = Recording(results.folder.run(other["run_id"]).recording)
    assert recording.channel("truth").shape == (101, 2, 3)
    assert recording.context().run_id == other["run_id"]
    recording.close()


def test_what_a_killed_analysis_left_is_no_part_of_the_next(analyze, foreign, tmp_path):
    bag = passing(foreign(), seconds=20).close()
    _, first, _ = analyze(bag)
    left = load(tmp_path / "measured").folder.run(first["run_id"], 2).exports
    left.mkdir(parents=True)
    (left / "half.bag").write_text("written by a process that was killed")
    _, again, _ = analyze(bag)
    assert again["attempt"] == 2
    assert not any("half.bag" in line for line in again["provenance"]["files"])
    assert not left.exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--start-time", 30), "poses begin at 0 and end at 20 s"),
        (("--rate", 0), "--rate: must be above 0"),
        (("--metrics", "nonsense"), "no metric is called 'nonsense'"),
        (("--robots", "z"), "holds no pose of any robot that z names"),
        (("--option", "odometri=[x]"), "odometri"),
    ],
)
def test_mistakes_are_one_line(analyze, foreign, words, message):
    code, found, error = analyze(passing(foreign(), seconds=20).close(), *words)
    assert (code, found) == (2, None)
    assert message in error
    assert error.count("\n") == 1


def test_a_foreign_bag_needs_world_and_scenario(analyze, foreign):
    code, _, error = analyze(passing(foreign()).close(), known=True)
    assert code == 2
    assert "needs --world" in error


def test_a_bag_of_another_scenario_is_refused(analyze, own):
    folder, record = own
    code, _, error = analyze(folder / "exports" / record["run_id"] / "rosbag2")
    assert code == 2
    assert f"the recording was made of {record['scenario_id']}" in error
