"""Compare the speed of executions with that of an older commit, in one run on one machine.

The commit is checked out and installed beside this one, in `build/speed/`, and rows of `full_stack.py` of both are
executed in turns, once in each round. The table has, for each row, the ratio of this version's simulated seconds per
CPU second to those of the other one: the median of the rounds, the least and the greatest. The first line is the speed
of the machine itself, by a fixed program of integer arithmetic.
"""

import argparse
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STEPS = 1_000_000
"""Of the fixed program."""
ROWS = ("planar-9", "planar-100", "planar-400", "bodies-9", "planar-1000-pure_pursuit", "planar-9-mppi")
PROGRAM = """
import sys

import attrs
from full_stack import ROWS, run

clock = run(attrs.evolve(ROWS[sys.argv[1]][0], seconds=float(sys.argv[2])))
print(clock.simulated / clock.cpu)
"""
"""Executes one row with the version of the folder that it runs in."""


def machine_speed() -> float:
    """Return millions of steps of a linear congruential generator per CPU second: the median of five measurements."""

    def measure() -> float:
        number, begin = 1, time.process_time()
        for _ in range(STEPS):
            number = (6364136223846793005 * number + 1442695040888963407) & 0xFFFFFFFFFFFFFFFF
        return STEPS / 1e6 / (time.process_time() - begin)

    return statistics.median(measure() for _ in range(5))


def checkout(commit: str) -> Path:
    """Check a commit out and install it into an environment of its own, if that is not done yet; return its folder."""
    name = subprocess.run(
        ["git", "rev-parse", "--verify", f"{commit}^{{commit}}"], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout.strip()
    folder = ROOT / "build" / "speed" / name[:12]
    if not folder.is_dir():
        # A folder that someone deleted is still a worktree to Git.
        subprocess.run(["git", "worktree", "add", "--force", "--detach", folder, name], cwd=ROOT, check=True)
    installed = folder / ".venv" / "installed"
    if not installed.exists():
        subprocess.run([sys.executable, "-m", "venv", ".venv"], cwd=folder, check=True)
        install = [".venv/bin/python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        subprocess.run([*install, "-r", "requirements.txt"], cwd=folder, check=True)
        installed.touch()
    return folder


def factor(folder: Path, python: Path, row: str, seconds: float) -> float:
    """Return the simulated seconds per CPU second of one execution of a row."""
    command = [python, "-c", PROGRAM, row, str(seconds)]
    execution = subprocess.run(command, cwd=folder / "benchmarks", check=False, capture_output=True, text=True)
    if execution.returncode:
        raise SystemExit(f"{folder}: {row} was not executed:\n{execution.stderr}")
    return float(execution.stdout.splitlines()[-1])


def main() -> None:
    """Measure the rows and print the ratios."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base", help="commit, tag or branch to compare with")
    parser.add_argument("--rows", nargs="+", default=list(ROWS), help=f"of full_stack.py (default: {', '.join(ROWS)})")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=20.0, help="simulated, of each execution")
    options = parser.parse_args()
    base = checkout(options.base)
    print(f"machine: {machine_speed():.2f} million steps per CPU second; base: {options.base} ({base.name})")
    print(f"{'':26} {'ratio':>6} {'least':>6} {'greatest':>8}")
    for row in options.rows:
        ratios = []
        for _ in range(options.rounds):
            before = factor(base, base / ".venv" / "bin" / "python", row, options.seconds)
            ratios.append(factor(ROOT, Path(sys.executable), row, options.seconds) / before)
        print(f"{row:<26} {statistics.median(ratios):>6.2f} {min(ratios):>6.2f} {max(ratios):>8.2f}", flush=True)


if __name__ == "__main__":
    main()
