"""`mrpbench verify BUNDLE`: check published results, and repeat a sample of their runs."""

import argparse
import json
import sys
from contextlib import nullcontext, redirect_stdout
from pathlib import Path

from mrpbench_core.cli.output.progress import Printed
from mrpbench_core.cli.output.table import print_json
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.output import write_page_file
from mrpbench_core.files.text import counted
from mrpbench_publish.bundles.verdict import Check
from mrpbench_publish.bundles.verify import VerifyOptions, verify
from mrpbench_publish.commands.share import read_share


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "Exit code: 0 nothing was found, 1 something was, 2 the bundle cannot be read. Nothing that a bundle contains"
        " is executed without --trust-sources. Measured times cannot be verified."
    )
    parser.add_argument("bundle", metavar="BUNDLE", help="the zip file that `mrpbench publish` wrote")
    parser.add_argument(
        "--rerun", metavar="SHARE", default="none", help="share of the runs to repeat, e.g. 10%% or `all`"
    )
    parser.add_argument(
        "--seed", metavar="N", help="draws these runs (default: a new one); the publisher must not know it before"
    )
    parser.add_argument(
        "--trust-sources", action="store_true", help="execute the local plugins and programs that the bundle contains"
    )
    parser.add_argument("--inputs", metavar="DIR", help="folder with the inputs that the bundle leaves out")
    parser.add_argument("--workers", type=int, default=1, metavar="N", help="number of runs at a time (default: 1)")
    parser.add_argument("--json", action="store_true", help="print the verdict as JSON")
    parser.add_argument(
        "--out", metavar="FILE", help="write the verdict as JSON; `mrpbench site` reads it from BUNDLE.verdict.json"
    )


def run(arguments: argparse.Namespace) -> int:
    """Verify the bundle and print a line for each check."""
    if arguments.seed is not None and arguments.rerun == "none":
        raise InputError("--seed draws the runs to repeat", hint="add --rerun SHARE")
    options = VerifyOptions(
        rerun=read_share(arguments.rerun, "--rerun"),
        seed=arguments.seed,
        trusted=arguments.trust_sources,
        inputs=Path(arguments.inputs) if arguments.inputs else None,
        workers=arguments.workers,
        progress=Printed(),
    )
    said = None if arguments.json else _print
    with slots_of_this_process() as slots, redirect_stdout(sys.stderr) if arguments.json else nullcontext():
        verdict = verify(Path(arguments.bundle), options, slots, said)
    if arguments.out:
        write_page_file(Path(arguments.out), json.dumps(verdict.document(), indent=1, ensure_ascii=False) + "\n")
    if arguments.json:
        print_json(verdict.document())
        return int(not verdict.passed)
    findings = sum(len(check.findings) for check in verdict.checks)
    print(f"SHA-256: {verdict.sha256}")
    print(f"{verdict.bundle}: " + ("nothing was found" if verdict.passed else counted(findings, "finding")))
    return int(not verdict.passed)


def _print(check: Check) -> None:
    print(f"{check.name:<12} {check.outcome:<12} {check.covered}", flush=True)
    for finding in check.findings:
        print(f"{'':<12} - {finding}")
