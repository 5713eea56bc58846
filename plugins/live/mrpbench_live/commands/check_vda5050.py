"""`mrpbench check-vda5050 vehicle|control URL`: the rules of VDA 5050 that an outside party keeps."""

import argparse
import json
import textwrap

from mrpbench_core.cli.output.table import print_json
from mrpbench_core.files.errors import InputError
from mrpbench_live.vda5050.check.control import ControlCheck
from mrpbench_live.vda5050.check.conversation import Conversation
from mrpbench_live.vda5050.check.rules import BROKEN, Report
from mrpbench_live.vda5050.check.vehicle import RULES, VehicleCheck

SHOWN = 600
"""Characters of a message that are printed."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "A vehicle is asked, by orders and actions that do not move it, unless --drive says where it may drive; it has"
        " to be idle. A fleet control is listened to while it works."
        " Exit code: 0 no rule is broken, 1 some are, 2 the party cannot be reached."
    )
    parser.add_argument("party", choices=("vehicle", "control"), help="who is checked")
    parser.add_argument("url", metavar="URL", help="broker, e.g. mqtt://127.0.0.1:1883")
    parser.add_argument("--version", choices=("2.1", "3.0"), default="3.0", help="of VDA 5050 (default: 3.0)")
    parser.add_argument("--vehicle", metavar="MANUFACTURER/SERIAL", help="the vehicle that is asked")
    parser.add_argument(
        "--topics", default="", metavar="PREFIX", help="what topics begin with (default: uagv/v2 or vda5050/v3)"
    )
    parser.add_argument(
        "--drive",
        metavar="X,Y",
        help="where the vehicle may drive straight, and back, to ask about corridors and zones",
    )
    parser.add_argument(
        "--seconds", type=float, metavar="S", help="how long to listen to a control (60), or to wait for an answer (5)"
    )
    parser.add_argument("--json", action="store_true", help="print the findings as JSON, with whole messages")


def run(arguments: argparse.Namespace) -> int:
    """Check, and print each rule."""
    version, topics = arguments.version, arguments.topics
    if arguments.party == "control":
        report = ControlCheck(arguments.url, version, topics).run(arguments.seconds or 60.0)
    else:
        manufacturer, slash, serial = (arguments.vehicle or "").partition("/")
        if not slash or not serial:
            raise InputError("no vehicle is named", hint="--vehicle MANUFACTURER/SERIAL")
        patience = arguments.seconds or 5.0
        drive = _place(arguments.drive)
        report = Report(RULES)
        conversation = Conversation(arguments.url, version, topics, manufacturer, serial, patience, report)
        VehicleCheck(conversation, report, drive).run()
    if arguments.json:
        print_json({name: vars_of(finding) for name, finding in report.findings.items()})
    else:
        _print(report)
    return int(report.broken)


def _place(text: str | None) -> tuple[float, float] | None:
    """Read `X,Y` in metres."""
    if text is None:
        return None
    try:
        x, y = map(float, text.split(","))
    except ValueError:
        raise InputError(f"--drive {text}: expected two numbers in metres", hint="--drive 4.5,2.5") from None
    return x, y


def vars_of(finding: object) -> dict[str, object]:
    """Return a finding as plain data."""
    return {name: getattr(finding, name) for name in ("rule", "verdict", "reason", "message")}


def _print(report: Report) -> None:
    for finding in report.findings.values():
        print(f"{finding.verdict:10}  {finding.rule}" + (f": {finding.reason}" if finding.reason else ""))
        if finding.verdict == BROKEN and finding.message is not None:
            text = textwrap.shorten(json.dumps(finding.message), SHOWN, placeholder=" …")
            print(f"{'':12}{text}")
