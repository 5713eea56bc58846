"""`mrpbench publish RESULTS… --out BUNDLE.zip`: write results as a bundle that others can verify."""

import argparse
import re
import sys
from datetime import date
from pathlib import Path

from mrpbench_core.cli.output.table import print_json
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted
from mrpbench_core.store.results import load
from mrpbench_publish.bundles.publish import PublishOptions, publish
from mrpbench_publish.commands.share import read_share
from mrpbench_publish.files.description import Author


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "The bundle holds the records, studies, versions and inputs, and a description (BagIt, RO-Crate, CITATION.cff)."
        " The same results give the same bytes. Unfinished studies and mixed versions are refused."
    )
    parser.add_argument("folders", nargs="+", metavar="RESULTS", help="results folders of one study, or of its shards")
    parser.add_argument("--out", required=True, metavar="BUNDLE.zip", help="the bundle")
    parser.add_argument(
        "--recordings",
        default="all",
        metavar="SHARE",
        help="recordings to include: `all` (default), `none`, or a share such as 10%% that is drawn by the run ids",
    )
    parser.add_argument("--title", help="title of the data (default: the name of the study)")
    parser.add_argument("--description", metavar="TEXT", help="what the data are")
    parser.add_argument(
        "--author", action="append", default=[], metavar="NAME", help='`Name` or "Name <ORCID>"; may be repeated'
    )
    parser.add_argument(
        "--license", default="CC-BY-4.0", metavar="SPDX", help="licence of the data, by its SPDX name (%(default)s)"
    )
    parser.add_argument("--date", metavar="YYYY-MM-DD", help="of publication (default: that of the newest invocation)")
    parser.add_argument(
        "--inputs", default=".", metavar="DIR", help="folder of the configuration, to which its files are relative"
    )
    parser.add_argument(
        "--leave-out",
        action="append",
        default=[],
        metavar="PATTERN",
        help="inputs that may not be copied, such as '*.map': the bundle has their SHA-256 only; may be repeated",
    )
    parser.add_argument("--json", action="store_true", help="print the outcome as JSON")


def run(arguments: argparse.Namespace) -> int:
    """Write the bundle."""
    options = PublishOptions(
        title=arguments.title,
        text=arguments.description,
        authors=tuple(map(Author.read, arguments.author)),
        license=_license(arguments.license),
        published=_date(arguments.date),
        recordings=read_share(arguments.recordings, "--recordings"),
        inputs=Path(arguments.inputs),
        left_out=tuple(arguments.leave_out),
    )
    folders = [load(folder) for folder in dict.fromkeys(arguments.folders)]
    with slots_of_this_process() as slots:
        written = publish(folders, Path(arguments.out), options, slots)
    for note in written.notes:
        sys.stderr.write(f"note: {note}\n")
    if arguments.json:
        facts = {"file": str(written.file), "sha256": written.sha256, "runs": written.runs}
        print_json(facts | {"recordings": written.recordings, "notes": list(written.notes)})
        return 0
    size = written.file.stat().st_size / 1e6
    recordings = counted(written.recordings, "recording")
    print(f"wrote {written.file}: {counted(written.runs, 'run')}, {recordings}, {size:.2g} MB")
    print(f"SHA-256: {written.sha256}")
    print(f"`mrpbench verify {written.file}` checks it as others will")
    return 0


def _license(text: str) -> str:
    if not re.fullmatch(r"[A-Za-z0-9.+-]+", text):
        raise InputError(f"--license {text}: expected an SPDX name such as CC-BY-4.0", hint="https://spdx.org/licenses")
    return text


def _date(text: str | None) -> str | None:
    try:
        return None if text is None else date.fromisoformat(text).isoformat()
    except ValueError:
        raise InputError(f"--date {text}: expected YYYY-MM-DD") from None
