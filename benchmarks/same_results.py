"""List the runs of studies whose status or values differ between two checkouts.

    python benchmarks/same_results.py ../base/.venv/bin/python .venv/bin/python --limit 2

Each Python executes the first runs of each study with the mrpbench that it imports. Wall and CPU times do not count.
A study that needs a file that is absent is named and left out.
"""

import argparse
import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

STUDIES = Path(__file__).parent.parent / "studies"
EXECUTE = """
import json, sys, tempfile
from pathlib import Path
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.run import execute
from mrpbench_core.files.errors import InputError
from mrpbench_core.store.paths import RunPaths

study, limit = Path(sys.argv[1]), int(sys.argv[2])
try:
    runs = load_study(study).runs[:limit]
    for number, point in enumerate(runs):
        with tempfile.TemporaryDirectory() as folder:
            paths = RunPaths(recording=Path(folder) / "run.zip", exports=Path(folder) / "exports")
            record = execute(point.config, point.run_id, paths)
        values = {"status": str(record.status), "plan": record.plan, **record.metrics}
        print(json.dumps([number, values], default=float), flush=True)
except InputError as error:
    print(json.dumps([-1, {"refused": str(error)}]))
except Exception as error:
    print(json.dumps([-1, {"raised": repr(error)}]))
"""
TIMED = ("planning.time", "planning.cpu", "planning.peak", "planning.memory", "real_time", "wall")
"""Beginnings or parts of columns that differ from run to run."""


def main() -> None:
    """Print the differences and their number; exit with 1 if there are some."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pythons", nargs=2, metavar="PYTHON", help="interpreters of the two checkouts")
    parser.add_argument("--limit", type=int, default=1, help="runs of each study (default: %(default)s)")
    parser.add_argument("--studies", nargs="+", type=Path, default=sorted(STUDIES.glob("*.yaml")))
    parser.add_argument("--seconds", type=float, default=600.0, help="wall time for a study (default: %(default)s)")
    arguments = parser.parse_args()
    differing = 0
    for study in arguments.studies:
        one, other = (executed(python, study, arguments.limit, arguments.seconds) for python in arguments.pythons)
        lines = [
            f"  run {number} {name}: {one.get(number, {}).get(name)} and {other.get(number, {}).get(name)}"
            for number in sorted(one.keys() | other.keys())
            for name in sorted(one.get(number, {}).keys() | other.get(number, {}).keys())
            if not same(one.get(number, {}).get(name), other.get(number, {}).get(name))
        ]
        refused = one.get(-1, {}).get("refused", "\n").splitlines()[0][:80]
        print(f"{study.stem}: {len(one)} runs, {len(lines)} differences {refused}")
        print("\n".join(lines), end="\n" if lines else "", flush=True)
        differing += len(lines)
    sys.exit(differing > 0)


def executed(python: str, study: Path, limit: int, seconds: float) -> dict[int, dict[str, Any]]:
    """The values of the first runs of a study, by number; those that took too long are missing."""
    command = [str(Path(python).absolute()), "-P", "-c", EXECUTE, study.name, str(limit)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=study.parent
    ) as process:
        try:
            printed = process.communicate(timeout=seconds)[0]
        except subprocess.TimeoutExpired:
            process.kill()
            printed = process.communicate()[0] or ""
    rows = (json.loads(line) for line in printed.splitlines() if line.startswith("["))
    return {
        number: {name: value for name, value in values.items() if not any(part in name for part in TIMED)}
        for number, values in rows
    }


def same(one: Any, other: Any) -> bool:
    """Tell whether two values are equal; NaN is equal to itself."""
    if isinstance(one, float) and isinstance(other, float) and math.isnan(one):
        return math.isnan(other)
    return bool(one == other)


if __name__ == "__main__":
    main()
