"""Presets, labels and promises: each preset calls a stand-in that takes the documented arguments of its program."""

import sys

import attrs
import pytest
from mrpbench_planners_external import External
from mrpbench_planners_external.presets import PRESETS

from mrpbench_core.api import Promise
from mrpbench_core.checking.plan import check_plan
from mrpbench_core.model.planning.plan import Budget, PlanStatus
from mrpbench_core.referee.plans import Promises, judge_plan
from mrpbench_core.testing.drawing import problem

AMPLE = Budget(wall_s=30.0, memory_bytes=1 << 30, seed=7)
COMMON = """#!{python} -IS
import argparse
parser = argparse.ArgumentParser()
"""
LINES = """
rows = open(given.m).read().splitlines()[4:]
tasks = [tuple(map(int, line.split()[4:8])) for line in open(given.SCEN).read().splitlines()[1:]]
assert len(tasks) == given.AGENTS and given.t > 0
paths = []
for c, r, goal_c, goal_r in tasks:  # along the row, then along the column
    path = [(r, c)]
    while path[-1] != (goal_r, goal_c):
        r, c = path[-1]
        path.append((r, c + (1 if goal_c > c else -1)) if c != goal_c else (r + (1 if goal_r > r else -1), c))
    paths.append(path)
"""
AGENTS = (
    COMMON
    + """
parser.add_argument("-m", required=True)
parser.add_argument("-a", required=True)
parser.add_argument("-o", required=True)
parser.add_argument("--outputPaths", required=True)
parser.add_argument("-k", type=int, required=True)
parser.add_argument("-t", type=float, required=True)
MORE
given = parser.parse_args()
"""
    + LINES.replace("SCEN", "a").replace("AGENTS", "k")
    + """
with open(given.outputPaths, "w") as file:
    for robot, path in enumerate(paths):
        file.write(f"Agent {{robot}}: " + "".join(f"({{r}},{{c}})->" for r, c in path) + "\\n")
"""
)
STEPS = (
    COMMON
    + """
parser.add_argument("-m", required=True)
parser.add_argument("-i", required=True)
parser.add_argument("-o", required=True)
parser.add_argument("-N", type=int, required=True)
parser.add_argument("-t", type=float, required=True)
parser.add_argument("-s", type=int, required=True)
given = parser.parse_args()
"""
    + LINES.replace("SCEN", "i").replace("AGENTS", "N")
    + """
assert given.s == 7
longest = max(map(len, paths))
with open(given.o, "w") as file:
    file.write(f"agents={{given.N}}\\nmap_file=world.map\\nsolver=planner\\nsolved=1\\nsoc=1\\nstarts=(0,0),\\nsolution=\\n")
    for step in range(longest):
        cells = (path[min(step, len(path) - 1)] for path in paths)
        file.write(f"{{step}}:" + "".join(f"({{c}},{{r}})," for r, c in cells) + "\\n")
"""
)
SUBOPTIMALITY = 'parser.add_argument("--suboptimality", type=float, required=True)'
PROGRAMS = {
    "eecbs": AGENTS.replace("MORE", SUBOPTIMALITY),
    "cbsh2_rtc": AGENTS.replace("MORE", ""),
    "mapf_lns2": AGENTS.replace("MORE", ""),
    "lacam": STEPS,
}


@pytest.fixture
def program(tmp_path):
    """Return a function that writes an executable Python program."""

    def write(text):
        file = tmp_path / "program"
        file.write_text(text.format(python=sys.executable))
        file.chmod(0o755)
        return file

    return write


def rows_apart():
    """Two robots that do not meet."""
    return problem("""
        a  .  A  .
        .  .  .  .
        B  .  .  b
    """)


def test_every_preset_has_a_stand_in():
    assert set(PROGRAMS) == set(PRESETS)


@pytest.mark.parametrize("preset", PRESETS)
def test_a_preset_calls_its_program_as_documented_and_reads_its_paths(preset, program):
    w = 1.5 if preset == "eecbs" else None
    planner = External(binary=program(PROGRAMS[preset]), preset=preset, w=w)
    result = planner.plan(rows_apart(), AMPLE)
    assert result.status is PlanStatus.SOLVED
    assert check_plan(rows_apart(), result.plan).valid
    assert result.plan.sum_of_costs == 5


def test_further_arguments_come_last_and_own_ones_replace_those_of_the_preset(program):
    says = program("#!/bin/sh\necho $*\nexit 1\n")
    more = External(binary=says, preset="cbsh2_rtc", more_arguments="--heuristics=CG --seed={seed}")
    with pytest.raises(RuntimeError, match=r"-t 29\.5 --heuristics=CG --seed=7$"):
        more.plan(rows_apart(), AMPLE)
    own = External(binary=says, preset="lacam", arguments="{map} {agents}")
    assert own.format == "steps"
    with pytest.raises(RuntimeError, match=r": world\.map 2$"):
        own.plan(rows_apart(), AMPLE)


def test_a_result_file_that_says_unsolved_holds_no_plan(program):
    writes = program("#!/bin/sh\nprintf 'agents=2\\nsolved=0\\nsolution=\\n' > paths.txt\n")
    result = External(binary=writes, output="steps").plan(rows_apart(), AMPLE)
    assert (result.status, result.plan) == (PlanStatus.GAVE_UP, None)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"preset": "eecbs"}, r"w is missing: the arguments hand over \{w\}"),
        ({"promised": (Promise.BOUNDED,)}, "w is missing: the promise `bounded` refers to it"),
        ({"w": 0.9}, "'w' must be >= 1"),
        ({"more_arguments": "--x={y}"}, r"cannot be filled in: 'y'; it may use \{map\}"),
    ],
)
def test_options_that_do_not_fit_are_refused(options, said, program):
    with pytest.raises(ValueError, match=said):
        External(binary=program("#!/bin/sh\n"), **options)


def test_what_is_promised_is_checked(program):
    crossing = problem("""
        .  a  .
        b  .  B
        .  A  .
    """)
    planner = External(binary=program(PROGRAMS["lacam"]), preset="lacam")
    assert planner.promises == {Promise.CONFLICT_FREE}
    result = planner.plan(crossing, AMPLE)
    assert "vertex" in str(judge_plan(Promises.of(planner), crossing, result)[1])
    lenient = attrs.evolve(planner, promised=())
    assert judge_plan(Promises.of(lenient), crossing, result)[1] is None
    strict = Promises.of(attrs.evolve(planner, promised=(Promise.CONFLICT_FREE, Promise.BOUNDED), w=1.5))
    assert (strict.made, strict.factor) == ({Promise.CONFLICT_FREE, Promise.BOUNDED}, 1.5)
