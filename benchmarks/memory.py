"""Check that solvers keep their memory limit: measure by how much a process grows on a large instance.

    python benchmarks/memory.py --side 1000 --robots 1000 --limits 512 2048

Robots are drawn on a square grid with a fifth of the cells blocked. Each call has a process of its own; printed are the
status, what the solver counted, and the peak of the resident memory over what the process had just before (Linux).
Exits with 1 if some process took more than its limit, a tenth of it and 50 MB.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
from mrpbench_native import ALGORITHMS, Grid, solve

ALLOWED = 50e6
SHARE = 1.1


def crowd(side: int, robots: int, seed: int) -> tuple[Grid, np.ndarray, np.ndarray]:
    """A grid whose free cells are mostly in one piece, and robots with different starts and goals there."""
    random = np.random.default_rng(seed)
    free = random.random((side, side)) < 0.8
    reached = np.zeros_like(free)
    reached[side // 2, side // 2] = free[side // 2, side // 2] = True
    while True:
        grown = reached.copy()
        grown[1:] |= reached[:-1]
        grown[:-1] |= reached[1:]
        grown[:, 1:] |= reached[:, :-1]
        grown[:, :-1] |= reached[:, 1:]
        grown &= free
        if (grown == reached).all():
            break
        reached = grown
    cells = np.argwhere(reached)
    return Grid(free), random.permutation(cells)[:robots], random.permutation(cells)[:robots]


def peak() -> int:
    """Bytes of resident memory that this process has had at most (getrusage would answer for its parent too)."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(status.partition("VmHWM:")[2].split()[0]) * 1024


def call(side: int, robots: int, algorithm: str, limit: int, time_limit: float) -> None:
    """Solve once in this process and print what happened as JSON."""
    grid, starts, goals = crowd(side, robots, 1)
    before = peak()
    found = solve(grid, starts, goals, algorithm=algorithm, memory_limit=limit, time_limit=time_limit)
    counted = found.statistics.get("memory_bytes", 0)
    print(json.dumps({"status": found.status, "counted": counted, "grown": peak() - before}))


def main() -> None:
    """Measure the rows and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=int, default=1000, help="cells in a row")
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--algorithms", nargs="+", default=sorted(ALGORITHMS))
    parser.add_argument("--limits", nargs="+", type=int, default=[512, 2048], help="MiB")
    parser.add_argument("--seconds", type=float, default=20, help="time limit")
    parser.add_argument("--call", nargs=2, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.call:
        name, limit = arguments.call
        return call(arguments.side, arguments.robots, name, int(limit), arguments.seconds)
    bad = 0
    for limit in arguments.limits:
        for name in arguments.algorithms:
            same = [
                "--side",
                str(arguments.side),
                "--robots",
                str(arguments.robots),
                "--seconds",
                str(arguments.seconds),
            ]
            command = [sys.executable, __file__, *same, "--call", name, str(limit << 20)]
            answer = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
            over = answer["grown"] > SHARE * (limit << 20) + ALLOWED
            bad += over
            print(
                f"{name:12} {limit:5} MiB: {answer['status']:13} counted {answer['counted'] >> 20:5} MiB, "
                f"grew by {answer['grown'] >> 20:5} MiB{' TOO MUCH' * over}",
                flush=True,
            )
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
