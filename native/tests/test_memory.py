"""Memory limits hold: seen from outside, by how much a process grows."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

CALL = """
import sys
from pathlib import Path
import numpy as np
from mrpbench_native import solve

def peak():
    return 1024 * int(Path("/proc/self/status").read_text().partition("VmHWM:")[2].split()[0])

free = np.ones((400, 400), bool)
cells = np.random.default_rng(1).permutation(np.argwhere(free))
before = peak()
found = solve(free, cells[:500], cells[500:1000], algorithm=sys.argv[1], memory_limit=int(sys.argv[2]), time_limit=60)
print(found.status, found.statistics["memory_bytes"], peak() - before)
"""
LIMIT = 48 << 20
"""The distances of all robots to all cells take more, in pages of bytes."""
BEYOND = 40 << 20
"""Bytes that are not counted: the roadmap, and what `pbs` holds for each cell of a large map."""

SEARCHES = ("prioritized", "pbs", "cbs", "eecbs", "ita_cbs", "pibt", "lacam", "lns")
"""Algorithms whose searches hold different things; the others are variants of these."""


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="asks Linux for the peak of a process")
@pytest.mark.skipif("libasan" in os.environ.get("LD_PRELOAD", ""), reason="a sanitizer takes memory of its own")
@pytest.mark.parametrize("algorithm", SEARCHES)
def test_a_process_grows_little_beyond_the_memory_limit(algorithm):
    command = [sys.executable, "-c", CALL, algorithm, str(LIMIT)]
    status, counted, grown = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    assert status == "out_of_memory"
    assert int(counted) > LIMIT
    assert int(grown) < LIMIT + BEYOND
