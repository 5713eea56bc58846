import json

import pytest
from mrpbench_league.files.problem import read_problem

from mrpbench_core.files.errors import InputError

MAP = "type octile\nheight 2\nwidth 3\nmap\n.@E\n..S\n"


def written(folder, head, agents="#\n2\n0\n5\n", tasks="# v\n2\n3,4\n2\n"):
    (folder / "m.map").write_text(MAP)
    (folder / "a.agents").write_text(agents)
    (folder / "t.tasks").write_text(tasks)
    files = {"mapFile": "m.map", "agentFile": "a.agents", "taskFile": "t.tasks", "teamSize": 2, "numTasksReveal": 1.5}
    file = folder / "p.json"
    file.write_text(json.dumps(files | head, indent=1))
    return file


def test_the_three_seasons_are_read(tmp_path):
    later = read_problem(written(tmp_path, {"version": "2024 LoRR"}))
    assert later.season == 2024
    assert later.pool == 3
    assert later.start.tolist() == [0, 5]
    assert later.errands.tolist() == [3, 4, 2]
    assert later.first.tolist() == [0, 2, 3]
    assert later.blocked.tolist() == [[False, True, False], [False, False, False]]
    head = {"numTasksReveal": 1, "taskAssignmentStrategy": "roundrobin-fixed"}
    first = read_problem(written(tmp_path, head, tasks="2\n3\n4\n"))
    assert (first.season, first.strategy) == (2023, "roundrobin-fixed")
    delays = {"seed": 1, "minDelay": 2, "maxDelay": 9, "eventModel": "poisson", "pDelay": 0.01}
    delays |= {"durationModel": "uniform", "gaussMeanRatio": 0.5, "gaussStdRatio": 0.2}
    last = read_problem(written(tmp_path, {"version": "2026 LoRR", "agentCounter": 3, "delayConfig": delays}))
    assert (last.season, last.counter, last.size) == (2026, 3, 1.0)
    assert (last.delays.least, last.delays.most, last.delays.events) == (2, 9, "poisson")


@pytest.mark.parametrize(
    ("head", "files", "message"),
    [
        ({"version": "2025 LoRR"}, {}, r"p\.json:\d+: version: should be one of .*2026 LoRR"),
        ({"version": "2024 LoRR", "teamSize": 3}, {}, r"a\.agents: has 2 agents, teamSize is 3"),
        ({"version": "2024 LoRR", "teamSize": 2.5}, {}, r"p\.json:\d+: teamSize: should be a whole number"),
        ({"version": "2024 LoRR"}, {"agents": "2\n0\n1\n"}, r"a\.agents:3: cell 1 is blocked"),
        ({"version": "2024 LoRR"}, {"agents": "2\n0\n0\n"}, r"a\.agents:3: cell 0 is the start of line 2 too"),
        ({"version": "2024 LoRR"}, {"tasks": "2\n0,9\n2\n"}, r"t\.tasks:2: cell 9 is outside the map of 6 cells"),
        ({"version": "2024 LoRR"}, {"tasks": "2\n0,x\n2\n"}, r"t\.tasks:2: 'x' is not a cell"),
        ({"version": "2024 LoRR"}, {"tasks": "3\n0\n2\n"}, r"t\.tasks: has 2 of 3 lines"),
        ({}, {}, r"t\.tasks:3: should hold one cell"),
        (
            {},
            {"tasks": "2\n3\n2\n"},
            r"p\.json:\d+: numTasksReveal: should be a whole number of goals in 2023, is 1\.5",
        ),
        ({"version": "2024 LoRR", "numTasksReveal": 0.1}, {}, r"numTasksReveal: shows 0 tasks to 2 robots"),
        ({"version": "2024 LoRR", "mapFile": "none.map"}, {}, r"none\.map: no such file"),
        ({"version": "2026 LoRR", "delayConfig": {"minDelay": 3, "maxDelay": 1}}, {}, r"maxDelay: should be a whole"),
    ],
)
def test_a_mistake_is_named_with_its_place(tmp_path, head, files, message):
    with pytest.raises(InputError, match=message):
        read_problem(written(tmp_path, head, **files))


def test_what_is_no_json_is_named_with_its_line(tmp_path):
    file = tmp_path / "p.json"
    file.write_text('{\n"teamSize": 1,\n}')
    with pytest.raises(InputError, match=r"p\.json:3:\d+: is not JSON"):
        read_problem(file)
