"""The answer of a hunt: one sentence, and a folder for each failure."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import yaml

from mrpbench_core.cli.output.replays import replay_writer, try_write_replay
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.output import replace_file
from mrpbench_core.files.text import counted
from mrpbench_core.report.answer.wording import listed
from mrpbench_search.asking.brief import brief_config
from mrpbench_search.hunting.runs import CaseRuns, Judged
from mrpbench_search.hunting.search import Failure, Hunt


def sentence(name: str, hunt: Hunt) -> str:
    """Say what was found."""
    tried = counted(hunt.tried - len(hunt.left_out), "case")
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
        "cases": hunt.tried - len(hunt.left_out),
        "left_out": len(hunt.left_out),
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


def write_failure(folder: Path, failure: Failure, runs: CaseRuns) -> dict[str, str]:
    """Write what repeats and shows the smallest case of a failure into a folder.

    Returns:
        The names of what was written: `scenario`, `study` and, where there is a recording, `replay`.
    """
    folder.mkdir(parents=True, exist_ok=True)
    smallest = failure.smallest
    scenario, study = folder / "scenario.yaml", folder / "study.yaml"
    smallest.case.write(folder).replace(scenario)
    configs = [_with_scenario(brief_config(point, folder)) for point in runs.points(smallest.case)]
    shared = {key: value for key, value in configs[0].items() if all(other.get(key) == value for other in configs)}
    document = {"name": folder.name, **shared}
    if len(configs) > 1:
        own = [{key: value for key, value in config.items() if key not in shared} for config in configs]
        document["matrix"] = {"include": own}
    text = f"# {failure.kind}: {failure.reason}\n{yaml.safe_dump(document, sort_keys=False, allow_unicode=True)}"
    replace_file(study, text.encode())
    found = {"scenario": str(scenario), "study": str(study)}
    if page := _replay(folder / "replay.html", smallest, runs):
        found["replay"] = str(page)
    return found


def _with_scenario(config: dict[str, Any]) -> dict[str, Any]:
    """The configuration with the scenario file that lies beside it."""
    file = {"plugin": "file", "file": "scenario.yaml"}
    return config | {"scenario": file} | ({"tasks": file} if "tasks" in config else {})


def _replay(page: Path, judged: Judged, runs: CaseRuns) -> Path | None:
    """Write the replay of a case, of both runs side by side if there are two."""
    results = runs.results_of(judged)
    ids = [record["run_id"] for record in judged.records]
    if len(ids) == 1:
        return page if try_write_replay(results, ids[0], page) else None
    writer = replay_writer()
    if writer is None or not all(results.paths(run_id).recording.is_file() for run_id in ids):
        return None
    try:
        writer.write_replays([(results, results[run_id]) for run_id in ids], [run_id[:12] for run_id in ids], page)
    except InputError:  # in one of them nothing moves
        return None
    return page
