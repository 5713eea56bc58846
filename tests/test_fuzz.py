"""Some changed inputs for every reader of files, every time; `make fuzz` gives them many more."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent


def test_changed_files_are_read_or_refused_in_one_line(tmp_path):
    command = [sys.executable, "fuzz/run.py", "--plain", "--inputs=20", "--seconds=0.25", f"--corpus={tmp_path}"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    counts = re.findall(r"^(\w+): (\d+) inputs, (\d+) refused, 0 failures", done.stdout, re.MULTILINE)
    assert done.returncode == 0, done.stdout + done.stderr
    assert {"records", "recordings", "studies", "nav2", "robots", "urdfs", "mcap", "sqlite3"} <= {
        name for name, *_ in counts
    }
    assert any(0 < int(refused) < int(inputs) for _, inputs, refused in counts)
