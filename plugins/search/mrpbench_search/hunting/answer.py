"""The answer of a hunt: one sentence, and a folder for each failure."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import yaml

from mrpbench_core.cli.output.replays import replay_writer, try_write_replay
from mrpbench_core.files.output import replace_file
from mrpbench_core.files.text import counted
from mrpbench_core.report.answer.wording import listed
from mrpbench_search.hunting.runs import CaseRuns, Judged
from mrpbench_search.hunting.search import Failure, Hunt


def sentence(name: str, hunt: Hunt) -> str:
    """Say what was found."""
    tried = counted(hunt.tried, "case")
    if not hunt.failures:
        return f"{name}: nothing breaks `{hunt.runs.tried.text}` in {tried}"
    found = [f"{each.kind} with {counted(each.smallest.case.robots, 'robot')}" for each in hunt.failures.values()]
    count = "1 failure" if len(found) == 1 else f"{len(found)} different failures"
    return f"{name}: {count} in {tried}: {listed(found)}"


def document(name: str, hunt: Hunt, files: Sequence[dict[str, str]], runs: int, end: str, out: Path) -> dict[str, Any]:
    """Return the answer as JSON."""
    return {
        "answer": sentence(name, hunt),
        "for": hunt.runs.tried.text,
        "failures": [
            {
                "kind": each.kind,
                "reason": each.reason,
                "robots": each.smallest.case.robots,
                "tasks": len(each.smallest.case.tasks),
                "faults": len(each.smallest.case.events),
                "smallest": each.is_smallest,
                "found_after": each.after,
                "times": each.times,
                "again": each.again,
                "repeats": each.repeats,
                "runs": [record["run_id"] for record in each.smallest.records],
                "files": written,
            }
            for each, written in zip(hunt.failures.values(), files, strict=True)
        ],
        "others": hunt.others,
        "cases": hunt.tried,
        "runs": runs,
        "ended": end,
        "out": str(out),
    }


def table(failures: Sequence[Failure]) -> tuple[list[str], list[list[Any]]]:
    """Return headings and cells."""
    cells = [
        [
            number,
            each.kind,
            each.smallest.case.robots,
            len(each.smallest.case.tasks),
            len(each.smallest.case.events) + len(each.smallest.case.crowds),
            each.after,
            each.times,
            None if each.again is None else f"{each.again} of {each.repeats}",
            each.smallest.records[0]["run_id"][:12],
        ]
        for number, each in enumerate(failures, start=1)
    ]
    names = ["", "failure", "robots", "tasks", "faults and crowds", "found after", "times", "again", "run"]
    return names, cells


def write_failure(folder: Path, failure: Failure, runs: CaseRuns, origin: Path) -> dict[str, str]:
    """Write what repeats and shows the smallest case of a failure.

    Args:
        folder: of the failure.
        failure: to write.
        runs: of the hunt.
        origin: folder of the study, to which files in its configuration are relative.

    Returns:
        The names of what was written: `scenario`, `study` and, where there is a recording, `replay`.
    """
    folder.mkdir(parents=True, exist_ok=True)
    smallest = failure.smallest
    drawn = smallest.case.write(folder)
    scenario = folder / "scenario.yaml"
    drawn.replace(scenario)
    study = folder / "study.yaml"
    records = smallest.records
    document = _study(records[0]["config"], origin, folder) | {"name": folder.name}
    if len(records) > 1:
        document["matrix"] = {"include": [_differing(records, place, origin, folder) for place in range(len(records))]}
    text = f"# {failure.kind}: {failure.reason}\n{yaml.safe_dump(document, sort_keys=False, allow_unicode=True)}"
    replace_file(study, text.encode())
    found = {"scenario": str(scenario), "study": str(study)}
    if page := _replay(folder / "replay.html", smallest, runs):
        found["replay"] = str(page)
    return found


def _study(config: dict[str, Any], origin: Path, folder: Path) -> dict[str, Any]:
    """The configuration of a run with files relative to a folder, and the scenario file that lies there."""
    moved: dict[str, Any] = _moved(config, origin, folder)
    moved["scenario"] = {"plugin": "file", "file": "scenario.yaml"}
    if isinstance(config["tasks"], dict):
        moved["tasks"] = {"plugin": "file", "file": "scenario.yaml"}
    return moved


def _differing(records: Sequence[Any], place: int, origin: Path, folder: Path) -> dict[str, Any]:
    """The settings of one of several runs that are not those of the others, as an entry of `matrix.include`."""
    configs = [record["config"] for record in records]
    keys = [key for key, value in configs[place].items() if any(other[key] != value for other in configs)]
    return {key: [_moved(configs[place][key], origin, folder)] for key in keys}


def _moved(value: Any, origin: Path, folder: Path) -> Any:
    """A part of a configuration with the names of files and of local plugins relative to another folder."""
    if isinstance(value, dict):
        if value.keys() == {"path", "sha256"}:
            return _relative(value["path"], origin, folder)
        return {
            key: _plugin(inner, origin, folder) if key == "plugin" else _moved(inner, origin, folder)
            for key, inner in value.items()
        }
    return [_moved(inner, origin, folder) for inner in value] if isinstance(value, list) else value


def _plugin(name: Any, origin: Path, folder: Path) -> Any:
    file, colon, cls = str(name).rpartition(":")
    if not colon or not file.endswith(".py"):
        return name
    moved = _relative(file, origin, folder)
    return f"{moved if moved.startswith('.') else f'./{moved}'}:{cls}"


def _relative(name: str, origin: Path, folder: Path) -> str:
    return Path(os.path.relpath(origin / name, folder)).as_posix()


def _replay(page: Path, judged: Judged, runs: CaseRuns) -> Path | None:
    """Write the replay of a case, of both runs side by side if there are two."""
    results = runs.results_of(judged)
    ids = [record["run_id"] for record in judged.records]
    if len(ids) == 1:
        return page if try_write_replay(results, ids[0], page) else None
    writer = replay_writer()
    if writer is None or not all(results.paths(run_id).recording.is_file() for run_id in ids):
        return None
    writer.write_replays([(results, results[run_id]) for run_id in ids], [run_id[:12] for run_id in ids], page)
    return page
