"""Change production code and count how many changes the tests find: `python scripts/mutants --count 80 --seed 1`.

The first call runs all tests once and records which lines each of them executes, in `build/mutants/record`; `--record`
does so again. Then each mutant takes the place of its file while the tests that execute the changed line run until one
fails. A mutant that no test finds survives. The same seed draws the same mutants of the same text; `--again` repeats
those of a report, for example of another commit.
"""

import argparse
import contextlib
import difflib
import fnmatch
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import attrs
import covering
from coverage import CoverageData
from drawing import ROOT, Mutant, draw, mutants, production_files

FOLDER = ROOT / "build/mutants"
RECORD = FOLDER / "record"
APPLIED = FOLDER / "applied.json"
"""The file that is changed now, and its text before; what an interrupted call leaves."""
COVERAGE = """\
[run]
data_file = {folder}/coverage
parallel = true
include = {root}/mrpbench_core/*
    {root}/native/python/*
    {root}/plugins/*/mrpbench_*
    {root}/plugins/*/*/mrpbench_*
disable_warnings = no-data-collected, module-not-imported, module-not-measured, no-ctracer
patch = subprocess, fork, _exit
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=80)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--files", nargs="*", default=["*"], help="patterns of production files")
    parser.add_argument("--without", nargs="*", default=[], help="patterns of production files to leave out")
    parser.add_argument("--budget", type=float, default=60.0, help="CPU seconds of tests per mutant")
    parser.add_argument("--record", action="store_true", help="record again which lines the tests execute")
    parser.add_argument("--tests", nargs="*", default=[], help="record these tests only")
    parser.add_argument("--again", type=Path, help="a report whose mutants to repeat")
    parser.add_argument("--report", type=Path, default=FOLDER / "report.json")
    arguments = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    restore()
    if arguments.record or not (RECORD / "tests.json").exists():
        record(arguments.tests)
    if arguments.again:
        drawn = [found for row in json.loads(arguments.again.read_text()) if (found := again(row))]
    else:
        chosen = [
            file
            for file in production_files()
            if any(fnmatch.fnmatch(file, pattern) for pattern in arguments.files)
            and not any(fnmatch.fnmatch(file, pattern) for pattern in arguments.without)
        ]
        drawn = draw(chosen, arguments.count, arguments.seed)
    lines, rows = Lines(), []
    for number, mutant in enumerate(drawn, 1):
        rows.append(judge(mutant, lines.tests(mutant, arguments.budget)))
        arguments.report.write_text(json.dumps(rows, indent=1) + "\n")
        print(
            f"{number:3}/{len(drawn)} {rows[-1]['result']:9} {mutant.file}:{mutant.line} {rows[-1]['by']}", flush=True
        )
    survivors = [row for row in rows if row["result"] == "survived"]
    for row in survivors:
        print(f"\n{row['file']}:{row['line']} ({row['kind']}, {row['tests']} tests)\n{row['diff']}", end="")
    print(f"\n{len(rows) - len(survivors)} of {len(rows)} mutants were found")


def again(row: dict[str, Any]) -> Mutant | None:
    """The mutant of a report, if its text still exists."""
    found = [mutant for mutant in mutants(row["file"]) if mutant.id == row["id"]] if Path(row["file"]).exists() else []
    if not found:
        print(f"{row['file']}:{row['line']} does not exist any more ({row['before']!r} -> {row['after']!r})")
    return found[0] if found else None


def record(tests: list[str]) -> None:
    """Run the tests once, with one context of coverage for each."""
    shutil.rmtree(RECORD, ignore_errors=True)
    RECORD.mkdir()
    (RECORD / "coveragerc").write_text(COVERAGE.format(folder=RECORD, root=ROOT))
    command = [sys.executable, "-m", "pytest", "-p", "covering", "-p", "no:cacheprovider", "--timeout", "600", *tests]
    environment = _environment() | {"MUTANTS_RECORD": str(RECORD)}
    with (RECORD / "log").open("w") as log:
        subprocess.run(command, cwd=ROOT, env=environment, stdout=log, stderr=log, check=False)
    combine = [sys.executable, "-m", "coverage", "combine", "--quiet", "--rcfile", str(RECORD / "coveragerc")]
    subprocess.run(combine, cwd=ROOT, stderr=subprocess.DEVNULL, check=True)  # files of killed processes are damaged
    for file in RECORD.glob("coverage.*"):
        file.unlink()
    (RECORD / "measured.json").rename(RECORD / "tests.json")  # all of the record is there
    measured = json.loads((RECORD / "tests.json").read_text())
    failed = [test for test, row in measured.items() if not row["passed"]]
    cpu = sum(row["cpu"] for row in measured.values())
    print(f"{len(measured)} tests, {cpu / 60:.1f} minutes of CPU; failed, and not used: {failed}", flush=True)


class Lines:
    """Which tests execute a line."""

    def __init__(self) -> None:
        self._data = CoverageData(str(RECORD / "coverage"))
        self._data.read()
        self._tests = json.loads((RECORD / "tests.json").read_text())
        self._of_context: dict[str, list[str]] = {}
        for test, row in self._tests.items():
            if row["passed"]:
                for context in (test, covering.FILE + _file_of(test), *row["fixtures"]):
                    self._of_context.setdefault(context, []).append(test)

    def tests(self, mutant: Mutant, budget: float) -> list[str]:
        """The cheapest tests that execute the changed line, beginning with those next to the file.

        A line that runs when its file is imported counts as executed by all tests that execute any line of the file.
        """
        of_line = self._data.contexts_by_lineno(str(ROOT / mutant.file))
        lines = [mutant.line] if mutant.in_function else list(of_line)
        contexts = {context for line in lines for context in of_line.get(line, [])}
        found = {test for context in contexts for test in self._of_context.get(context, [])}
        if not found:  # only imported, or only in processes that were killed
            found = {test for test in self._tests if _is_next_to(test, mutant.file) and self._tests[test]["passed"]}
        spent, chosen = 0.0, []
        for test in sorted(found, key=lambda test: (self._tests[test]["cpu"], test)):
            spent += self._tests[test]["cpu"]
            if chosen and spent > budget:
                break
            chosen.append(test)
        files = list(dict.fromkeys(map(_file_of, sorted(chosen, key=lambda test: not _is_next_to(test, mutant.file)))))
        return sorted(chosen, key=lambda test: files.index(_file_of(test)))  # fixtures of a file are made once


def judge(mutant: Mutant, tests: list[str]) -> dict[str, Any]:
    """Run the tests with the mutant in place."""
    row: dict[str, Any] = {**attrs.asdict(mutant), "tests": len(tests), "by": "", "seconds": 0.0}
    text = (ROOT / mutant.file).read_text()
    mutated = mutant.apply(text)
    row["diff"] = (
        "\n".join(list(difflib.unified_diff(text.split("\n"), mutated.split("\n"), lineterm="", n=2))[2:]) + "\n"
    )
    if not tests:
        return row | {"result": "survived"}
    chosen = FOLDER / "chosen.json"
    chosen.write_text(json.dumps(tests))
    files = list(dict.fromkeys(map(_file_of, tests)))
    options = ["-x", "-p", "covering", "-p", "no:cacheprovider", "--timeout", "60", "--tb", "no", "-rfE"]
    command = [sys.executable, "-m", "pytest", *options, *files]
    environment = _environment() | {"MUTANTS_TESTS": str(chosen), "PYTHONDONTWRITEBYTECODE": "1"}
    began = time.monotonic()
    with in_place(mutant.file, text, mutated):
        try:
            done = subprocess.run(
                command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                timeout=900, check=False,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return row | {"result": "found", "by": "the time limit", "seconds": 900.0}
    failures = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
    row["seconds"] = round(time.monotonic() - began, 1)
    return row | {"result": "found" if done.returncode else "survived", "by": (failures or [""])[0][:200]}


@contextlib.contextmanager
def in_place(file: str, text: str, mutated: str) -> Iterator[None]:
    """Put the mutated text in place of a file while the context lasts; the file then has its old time, too."""
    path = ROOT / file
    status = path.stat()
    APPLIED.write_text(json.dumps({"file": file, "text": text, "times": [status.st_atime_ns, status.st_mtime_ns]}))
    path.write_text(mutated)
    os.utime(path, (0, 0))  # no compiled file is of that time
    try:
        yield
    finally:
        restore()


def restore() -> None:
    """Put back the file that is changed, if one is."""
    if APPLIED.exists():
        applied = json.loads(APPLIED.read_text())
        (ROOT / applied["file"]).write_text(applied["text"])
        os.utime(ROOT / applied["file"], ns=tuple(applied["times"]))
        APPLIED.unlink()


def _file_of(test: str) -> str:
    return test.partition("::")[0]


def _is_next_to(test: str, file: str) -> bool:
    """Whether the test is in the file that mirrors a production file, or in the tests of its plugin."""
    path, name = Path(_file_of(test)), Path(file)
    if file.startswith("mrpbench_core/"):
        mirror = Path("tests", *name.parts[1:-1])
        return path == mirror / f"test_{name.name}" or (mirror in path.parents and name.stem == "__init__")
    return "tests" in path.parts and path.parts[:3] == name.parts[:3]


def _environment() -> dict[str, str]:
    return os.environ | {"PYTHONPATH": str(Path(__file__).parent)}


if __name__ == "__main__":
    main()
