"""A program plans: what it is given, and every way in which it can end."""

import os
import sys
import time
from pathlib import Path

import attrs
import numpy as np
import psutil
import pytest
from mrpbench_planners_external import External

from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Budget, PlanStatus
from mrpbench_core.model.planning.problem import Problem, features_of
from mrpbench_core.model.planning.roadmap import Raster, Roadmap

AMPLE = Budget(wall_s=30.0, memory_bytes=1 << 30, seed=7)
BLOCKED = {(1, 1), (2, 1)}  # row from the top, column
ROWS, COLUMNS = 4, 3

SOLVER = '''#!{python}
"""Breadth-first search for each robot alone, on MovingAI files."""
import sys
from collections import deque

world, scen, out, form, agents = sys.argv[1:]
lines = open(world).read().splitlines()
assert lines[:4] == ["type octile", "height 4", "width 3", "map"], lines
cells = lines[4:]


def way(start, goal):
    before = {{start: None}}
    queue = deque([start])
    while queue:
        row, column = at = queue.popleft()
        for r, c in ((row, column + 1), (row + 1, column), (row, column - 1), (row - 1, column)):
            if 0 <= r < len(cells) and 0 <= c < len(cells[0]) and cells[r][c] == "." and (r, c) not in before:
                before[r, c] = at
                queue.append((r, c))
    path = [goal]
    while path[-1] != start:
        path.append(before[path[-1]])
    return path[::-1]


ways = []
for line in open(scen).read().splitlines()[1:]:
    _, _, width, height, sx, sy, gx, gy, _ = line.split("\\t")
    assert (width, height) == ("3", "4")
    ways.append(way((int(sy), int(sx)), (int(gy), int(gx))))
assert len(ways) == int(agents)
longest = max(map(len, ways))
with open(out, "w") as file:
    if form == "agents":
        for robot, path in enumerate(ways):
            file.write(f"Agent {{robot}}: " + "".join(f"({{r}},{{c}})->" for r, c in path) + "\\n")
    elif form == "steps":
        for step in range(longest):
            cells = (path[min(step, len(path) - 1)] for path in ways)
            file.write(f"{{step}}:" + "".join(f"({{c}},{{r}})," for r, c in cells) + "\\n")
    else:
        file.write("schedule:\\n")
        for robot, path in enumerate(ways):
            file.write(f"  agent{{robot}}:\\n")
            for step, (r, c) in enumerate(path):
                file.write(f"    - {{{{x: {{c}}, y: {{r}}, t: {{step}}}}}}\\n")
'''


def program(tmp_path, text, name="solver"):
    file = tmp_path / name
    file.write_text(text.format(python=sys.executable))
    file.chmod(0o755)
    return file


def problem(starts=((0, 0), (0, 2)), goals=((3, 0), (3, 2))) -> Problem:
    """Robots on the raster above, by row from the top and column."""
    free = [(r, c) for r in range(ROWS) for c in range(COLUMNS) if (r, c) not in BLOCKED]
    vertex = {cell: index for index, cell in enumerate(free)}
    pairs = [((r, c), near) for r, c in free for near in ((r, c + 1), (r + 1, c), (r, c - 1), (r - 1, c))]
    edges = [(vertex[a], vertex[b]) for a, b in pairs if b in vertex]
    roadmap = Roadmap(
        position=[(c + 0.5, ROWS - 0.5 - r) for r, c in free],
        level=np.zeros(len(free)),
        heading=np.full(len(free), np.nan),
        edges=edges,
        duration=[[1] * len(edges)],
        tick=1.0,
        grid=Raster(shape=(ROWS, COLUMNS), cell_size=1.0, origin=(0.0, 0.0), cell=[(ROWS - 1 - r, c) for r, c in free]),
    )
    return Problem(
        roadmap=roadmap,
        profile=np.zeros(len(starts)),
        radius=np.full(len(starts), 0.2),
        start=[vertex[cell] for cell in starts],
        ready=np.zeros(len(starts)),
        goals=tuple(((vertex[cell],),) for cell in goals),
    )


@pytest.mark.parametrize("form", ["agents", "steps", "schedule"])
def test_the_paths_of_a_program_become_a_plan(tmp_path, form):
    planner = External(
        binary=program(tmp_path, SOLVER), output=form, arguments=f"{{map}} {{scen}} {{paths}} {form} {{agents}}"
    )
    asked = problem()
    assert planner.skip(asked) is None
    result = planner.plan(asked, AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert check_plan(asked, result.plan).valid
    assert result.plan.sum_of_costs == 6
    assert result.statistics["process_s"] > 0
    assert result.statistics["process_cpu_s"] > 0


def test_paths_may_come_on_the_standard_output(tmp_path):
    says = '#!/bin/sh\necho "Agent 0: (0,0)->(1,0)->(2,0)->(3,0)->"'
    result = External(binary=program(tmp_path, says), arguments="{map} {scen}").plan(
        problem(starts=((0, 0),), goals=((3, 0),)), AMPLE
    )
    assert result.plan.sum_of_costs == 3


@pytest.mark.parametrize(("seed", "given"), [(None, "7"), (0, "0")])
def test_a_program_is_given_the_seed_of_the_budget_unless_the_option_sets_one(tmp_path, seed, given):
    echo = program(tmp_path, '#!/bin/sh\necho "seed $2"; exit 1\n')
    with pytest.raises(RuntimeError, match=f"seed {given}"):
        External(binary=echo, arguments="{map} {seed}", seed=seed).plan(problem(), AMPLE)


def test_a_program_that_writes_nothing_has_found_nothing(tmp_path):
    result = External(binary=program(tmp_path, "#!/bin/sh\nexit 0")).plan(problem(), AMPLE)
    assert (result.status, result.plan) == (PlanStatus.GAVE_UP, None)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("#!/bin/sh\necho out of ideas >&2\nexit 3", "solver ended with exit code 3: out of ideas"),
        ("#!/bin/sh\nkill -SEGV $$", "solver ended with exit code -11: without output"),
        ("#!/bin/sh\nhead -c 100000 /dev/urandom > paths.txt", "not in the format 'agents'"),
        ("#!/bin/sh\necho nonsense > paths.txt", "not in the format 'agents': it has no Agent 0"),
        ("#!/bin/sh\necho 'Agent 0: (0,0)->' > paths.txt", "it has paths of 1 robots instead of 2"),
        (
            "#!/bin/sh\nprintf 'Agent 0: (0,0)->(1,1)->\\nAgent 1: (0,2)->' > paths.txt",
            r"robot 0 moves from cell \(0, 0\) to \(1, 1\)",
        ),
        (
            "#!/bin/sh\nprintf 'Agent 0: (0,1)->\\nAgent 1: (0,2)->' > paths.txt",
            "robot 0 does not begin at its start",
        ),
    ],
)
def test_the_error_of_a_failing_program_has_its_name_and_output(tmp_path, text, said):
    with pytest.raises(RuntimeError, match=said):
        External(binary=program(tmp_path, text)).plan(problem(), AMPLE)


@pytest.mark.parametrize("starter", ["", "setsid"])
def test_a_program_that_passes_its_time_is_killed_with_all_it_started(tmp_path, starter):
    sleep = ["sleep", f"321.{os.getpid()}"]  # no other process on this machine has it
    hangs = f"#!/bin/sh\n{starter} {' '.join(sleep)} &\n{' '.join(sleep)}\n"
    result = External(binary=program(tmp_path, hangs)).plan(problem(), attrs.evolve(AMPLE, wall_s=1))
    assert result.status is PlanStatus.TIMEOUT
    for _ in range(100):
        left = [one for one in psutil.process_iter(["cmdline"]) if one.info["cmdline"] == sleep]
        if not left:
            break
        time.sleep(0.05)
    assert not left


def test_a_program_that_passes_its_memory_is_killed(tmp_path):
    eats = "#!{python}\nimport time\nkept = bytearray(300_000_000)\ntime.sleep(321)\n"
    result = External(binary=program(tmp_path, eats)).plan(problem(), attrs.evolve(AMPLE, memory_bytes=100_000_000))
    assert result.status is PlanStatus.OUT_OF_MEMORY
    assert 100_000_000 < result.statistics["memory_bytes"] < 1_000_000_000


def test_a_problem_without_a_raster_is_skipped_with_the_reason(tmp_path):
    planner, asked = External(binary=program(tmp_path, SOLVER)), problem()
    free = attrs.evolve(asked.roadmap, grid=None)
    assert "does not have" in planner.skip(attrs.evolve(asked, roadmap=free))
    fewer = attrs.evolve(asked.roadmap, edges=asked.roadmap.edges[1:], duration=asked.roadmap.duration[:, 1:])
    assert "neighbouring cells" in planner.skip(attrs.evolve(asked, roadmap=fewer))
    slow = attrs.evolve(asked, roadmap=attrs.evolve(asked.roadmap, duration=asked.roadmap.duration * 2))
    assert planner.skip(attrs.evolve(slow, features=features_of(slow))) == "does not support edge_durations"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"binary": Path("nowhere")}, "not an executable program"),
        ({"arguments": "-m {maps}"}, r"cannot be filled in: 'maps'; it may use \{map\}"),
        ({"arguments": "-a {scen}"}, r"must hand over \{map\}"),
        ({"arguments": "'{map}"}, "No closing quotation"),
    ],
)
def test_wrong_options_are_refused(tmp_path, options, said):
    with pytest.raises(ValueError, match=said):
        External(**{"binary": program(tmp_path, SOLVER), **options})
