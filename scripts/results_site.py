"""Run the studies of the paper, publish and verify them, and make a site of the bundles: `make results-site`.

Runs that have a record are not repeated, so that an interrupted call continues.
"""

import argparse
import subprocess
import sys
from pathlib import Path

import yaml

from mrpbench_core.version import __version__

STUDIES = Path(__file__).parents[1] / "studies"
CHOSEN = {
    "table2": "Table II: plans found within 60 s",
    "table4": "Table IV: makespan and sum of costs",
    "safe": "Contacts between robots with the action dependency graph",
    "table3": "Table III: robots that arrive within 300 s",
}
"""Titles of the bundles. Fig. 5 has the planning times of the scenarios of Table IV."""


def main() -> int:
    """Make the site; return 1 if a bundle has findings."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="folder for results, bundles and site")
    parser.add_argument("--seeds", default="3000..3053", help="seeds of the scenarios")
    parser.add_argument("--studies", nargs="*", default=tuple(CHOSEN), help="names of studies")
    parser.add_argument(
        "--folder",
        type=Path,
        default=STUDIES,
        help="folder of studies and the maps that they name (default: studies)",
    )
    parser.add_argument(
        "--workers", default="1", help="number of runs at a time; with 1, times are what they are alone"
    )
    parser.add_argument("--rerun", default="5%", help="share of the runs that the verification repeats")
    arguments = parser.parse_args()
    out: Path = arguments.out
    out.mkdir(parents=True, exist_ok=True)
    bundles, findings = [], 0
    for name in arguments.studies:
        results, bundle = str(out / name), out / f"{name}.zip"
        study = arguments.folder / f"{name}.yaml"
        has_seeds = "seed" in yaml.safe_load(study.read_text(encoding="utf-8"))["matrix"]
        seeds = [f"seed={arguments.seeds}"] if has_seeds else []
        mrpbench("run", str(study), *seeds, "--out", results, "--workers", arguments.workers)
        about = ("--title", CHOSEN.get(name, name), "--author", "The mrpbench authors")
        inputs = ("--recordings", "5%", "--inputs", str(arguments.folder))
        mrpbench("publish", results, "--out", str(bundle), *inputs, *about)
        verdict = str(bundle.with_name(f"{bundle.name}.verdict.json"))
        findings |= mrpbench("verify", str(bundle), "--rerun", arguments.rerun, "--out", verdict)
        bundles.append(str(bundle))
    mrpbench("site", *bundles, "--out", str(out / "site"), "--title", f"mrpbench {__version__}")
    return findings


def mrpbench(*words: str) -> int:
    """Run a command; its exit code is 0 or 1, and everything else ends the script."""
    code = subprocess.run([sys.executable, "-m", "mrpbench_core.cli.main", *words]).returncode
    if code > 1:
        sys.exit(code)
    return code


if __name__ == "__main__":
    sys.exit(main())
