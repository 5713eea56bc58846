"""`mrpbench site BUNDLE… --out FOLDER`: make a static site of published results."""

import argparse
import json
import shutil
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted, read_text
from mrpbench_core.store.results import Results

if TYPE_CHECKING:
    from mrpbench_core.report.report import Report
    from mrpbench_publish.site.pages import Entry

REPLAYS = 4
"""Replays of each bundle that are written by default."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Any server for files serves the folder. BUNDLE.verdict.json, which `mrpbench verify --out` writes, is the"
        " verdict of a bundle; without it the bundle is verified now, and no run is repeated. Results of a bundle with"
        " findings are not ranked."
    )
    parser.add_argument("bundles", nargs="+", metavar="BUNDLE", help="zip files that `mrpbench publish` wrote")
    parser.add_argument("--out", required=True, metavar="FOLDER", help="folder of the site")
    parser.add_argument("--title", default="mrpbench results", help="title of the site (default: %(default)s)")
    parser.add_argument(
        "--replays", type=int, default=REPLAYS, metavar="N", help="replays of each bundle (default: %(default)s)"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the site."""
    from mrpbench_core.report.report import make_report
    from mrpbench_publish.site.boards import make_boards
    from mrpbench_publish.site.pages import write_site

    out = Path(arguments.out)
    with TemporaryDirectory(prefix="mrpbench-site-") as name:
        read = [_read(Path(file), Path(name, str(number))) for number, file in enumerate(arguments.bundles)]
        ranked = [(number, results) for number, (entry, results) in enumerate(read) if entry.passed and results]
        entries = [_stored(entry, Path(file), out) for (entry, _), file in zip(read, arguments.bundles, strict=True)]
        boards = []
        if ranked:
            report = make_report([results for _, results in ranked])
            boards = make_boards(report)
            for place, (number, _) in enumerate(ranked):
                entries[number] = _with_replays(entries[number], report, place, out, arguments.replays)
        shown = [entries[number] for number, _ in ranked]
        write_site([*shown, *(entry for entry in entries if entry not in shown)], boards, arguments.title, out)
    print(f"wrote {out / 'index.html'}: {counted(len(boards), 'board')}, {counted(len(entries), 'bundle')}")
    for entry in entries:
        print(f"{entry.file}: {entry.judgement}")
    return 0


def _read(file: Path, folder: Path) -> "tuple[Entry, Results | None]":
    """Verify or look up a bundle, and unpack it if nothing was found."""
    from mrpbench_core.store.folder import ResultsFolder
    from mrpbench_core.store.run_files import digest
    from mrpbench_publish.files.archive import unpack
    from mrpbench_publish.files.description import read_description
    from mrpbench_publish.files.layout import CRATE, RESULTS
    from mrpbench_publish.site.pages import Entry

    if not file.is_file():
        raise InputError("no such file", file=file)
    sha256 = digest(file)
    verdict = _verdict(file, sha256)
    description, results = None, None
    if verdict.get("passed") is True:
        folder.mkdir()
        unpack(file, folder)
        (top,) = folder.iterdir()
        description = read_description((top / CRATE).read_bytes())
        results = Results(ResultsFolder(top / RESULTS))
    entry = Entry(
        file=f"{file.stem}-{sha256[:8]}.zip",
        sha256=sha256,
        description=description,
        verdict=verdict,
        runs=0 if results is None else len(results),
        replays={},
    )
    return entry, results


def _verdict(file: Path, sha256: str) -> Mapping[str, Any]:
    from mrpbench_core.engine.processes.slots import slots_of_this_process
    from mrpbench_publish.bundles.verify import VerifyOptions, verify

    stored = file.with_name(f"{file.name}.verdict.json")
    if not stored.exists():
        with slots_of_this_process() as slots:
            return verify(file, VerifyOptions(), slots).document()
    try:
        value = json.loads(read_text(stored))
    except (ValueError, RecursionError):
        raise InputError("is not a verdict", file=stored, hint="`mrpbench verify --out` writes it") from None
    if not isinstance(value, dict) or value.get("sha256") != sha256:
        raise InputError(f"is not the verdict of {file.name}", file=stored, hint="verify the bundle again")
    return value


def _stored(entry: "Entry", file: Path, out: Path) -> "Entry":
    """Copy a bundle into the site."""
    try:
        (out / "bundles").mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, out / "bundles" / entry.file)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", file=out) from None
    return entry


def _with_replays(entry: "Entry", report: "Report", place: int, out: Path, most: int) -> "Entry":
    """Write replays of some runs: failed ones first, and every configuration in turn."""
    import attrs

    from mrpbench_core.cli.output.replays import try_write_replay

    results = report.folders[place]
    replays: dict[str, str] = {}
    (out / "replays").mkdir(exist_ok=True)
    for index in report.failures_first().tolist():
        if len(replays) == most:
            break
        run_id = report.runs.run_id[index]
        if int(report.runs.folder[index]) != place or not results.paths(run_id).recording.is_file():
            continue
        if try_write_replay(results, run_id, out / "replays" / f"{run_id}.html"):
            replays[run_id] = f"replays/{run_id}.html"
    return attrs.evolve(entry, replays=replays)
