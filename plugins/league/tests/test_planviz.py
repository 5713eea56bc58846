"""Outputs have what PlanViz 3.1 reads: paths of planner and robots from time 0 on without a gap, assignments that name
tasks. The readers here follow its documentation and share no code with `mrpbench_league`.
"""

import json
import re

import numpy as np
import pytest
from mrpbench_league.execute import Options, execute
from mrpbench_league.files.problem import Delays, LorrProblem

ROBOTS, COUNTER = 12, 3
CHUNK = re.compile(r"\[\((\d+),(\d+),(\d+),([0-3]),(\d+)\):\(([^)]*)\)\]")
DELAYS = Delays(least=2, most=9, events="bernoulli", probability=0.02, durations="uniform")


def written(folder, season, duration=230, robots=ROBOTS, delays=DELAYS, **options):
    random = np.random.default_rng(season)
    cells = random.permutation(64)
    each = 1 if season == 2023 else 2
    problem = LorrProblem(
        season=season,
        blocked=np.zeros((8, 8), bool),
        start=cells[:robots],
        errands=random.integers(0, 64, 30 * each),
        first=np.arange(0, 30 * each + 1, each),
        reveal=1.0 if season == 2023 else 1.5,
        counter=COUNTER if season == 2026 else 1,
        delays=delays if season == 2026 else None,
    )
    file = folder / "output.json"
    execute(problem, duration, Options(**{"iterations": 5, **options})).write(file)
    return json.loads(file.read_text())


def letters(text, season):
    """One letter per step or tick."""
    if season < 2026:
        return text.split(",")
    found, place = [], 0
    for chunk in CHUNK.finditer(text):
        assert chunk.start() == place
        assert int(chunk[1]) == len(found), "a gap between chunks"
        for run in chunk[6].split(","):
            letter, count = run.split()
            found += [letter] * int(count)
        place = chunk.end()
    assert place == len(text)
    return found


@pytest.mark.parametrize("season", [2023, 2024, 2026])
@pytest.mark.parametrize("planner", ["pibt", "epibt"])
def test_paths_are_complete(tmp_path, season, planner):
    output = written(tmp_path, season, planner=planner)
    assert output["actionModel"] == "MAPF_T"
    assert output.get("version") == (None if season == 2023 else f"{season} LoRR")
    for key in ("actualPaths", "plannerPaths"):
        paths = [letters(text, season) for text in output[key]]
        assert [len(path) for path in paths] == [output["makespan"]] * output["teamSize"]
        assert set().union(*paths) <= set("FRCWT")


@pytest.mark.parametrize(
    ("season", "robots", "duration"), [(2024, 12, 230), (2024, 60, 5), (2026, 12, 230), (2026, 12, 5)]
)
def test_assignments_and_events_name_tasks_of_the_file(tmp_path, season, robots, duration):
    output = written(tmp_path, season, duration, robots, active=2)
    errands = {task: len(places) // 2 for task, _, places in output["tasks"]}
    assert len(output["actualSchedule"]) == robots
    for text in output["actualSchedule"]:
        for entry in text.split(","):
            time, task = map(int, entry.split(":"))
            assert 0 <= time <= duration
            assert task == -1 or task in errands
    assert all(1 <= done <= errands[task] for _, _, task, done in output["events"])
    assert output["errors"] == output["scheduleErrors"] == []


def test_planned_steps_are_those_that_robots_take(tmp_path):
    output = written(tmp_path, 2024)
    assert output["plannerPaths"] == output["actualPaths"]


def both(output):
    """Planned and actual ticks after the first answer."""
    planned, actual = (
        np.array([letters(text, 2026) for text in output[key]]) for key in ("plannerPaths", "actualPaths")
    )
    assert (planned[:, :10] == "T").all()
    assert (actual[:, :10] == "W").all()
    return planned[:, 10:], actual[:, 10:]


def test_without_delays_planned_ticks_are_those_of_the_robots(tmp_path):
    planned, actual = both(written(tmp_path, 2026, delays=None))
    assert np.array_equal(planned, actual)


def test_what_a_delay_prevents_is_planned(tmp_path):
    output = written(tmp_path, 2026)
    planned, actual = both(output)
    assert (actual[planned != actual] == "W").all()
    delayed = np.zeros((ROBOTS, 230), bool)
    for robot, intervals in enumerate(output["delayIntervals"]):
        for start, end in intervals:
            delayed[robot, start:end] = True
    assert (planned[delayed[:, 10:]] != "W").any()
    assert (actual[delayed[:, 10:]] == "W").all()


@pytest.mark.parametrize(("season", "waited"), [(2023, "W"), (2024, "T")])
def test_steps_without_an_answer_are_planned_as_late(tmp_path, season, waited):
    output = written(tmp_path, season, 20, iterations=None, limit=1e-6)
    assert output["plannerPaths"] == [",".join("T" * 20)] * ROBOTS
    assert output["actualPaths"] == [",".join(waited * 20)] * ROBOTS
