"""Why a run failed, in one sentence, and which failures are the same."""

import re
from collections.abc import Sequence

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.run import RunContext
from mrpbench_core.report.reading.columns import direction
from mrpbench_core.store.recording import Recording
from mrpbench_core.store.results import Results
from mrpbench_search.hunting.properties import Bound, NotWorse, Property, Record, lateness

_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def reason_of(kind: str, tried: Property, records: Sequence[Record], results: Results) -> str:
    """Return a sentence on a failure, from the records and the recording of its runs."""
    record = records[0]
    if isinstance(tried, NotWorse) and kind == tried.text:
        return _compared(tried, records)
    if isinstance(tried, Bound) and kind == tried.text:
        return f"{tried.column} is {record['metrics'][tried.column]:.4g}"
    if kind == "contact":
        return _contact(record, results)
    if kind == "late" and (times := lateness(record)) is not None:
        took, planned = record["metrics"]["execution.duration_s"], record["metrics"]["planning.makespan"]
        return f"the last robot arrives after {took:.1f} s, {times:.1f} times the planned {planned:.1f} s"
    if kind == "late":
        return f"{record['metrics']['tasks.late']} tasks miss their deadline"
    error = record.get("error") or {}
    return str(error.get("message") or record["status"])


def signature(kind: str, reason: str, robots: Sequence[str]) -> str:
    """Return the same text for failures that differ only in robots, their number and order, places and times."""
    text = reason
    for name in sorted(robots, key=len, reverse=True):
        text = text.replace(name, "robot")
    text = _NUMBER.sub("#", text)
    text = re.sub(r"(robot)((?:, | and )+robot)+", r"\1", text)
    parts = {part for part in re.split("[;:] ", text) if not part.startswith("…")}
    return f"{kind}: {'; '.join(sorted(parts))}"


def robots_of(record: Record, results: Results) -> tuple[str, ...]:
    """Return the names of the robots of a recorded run; () if it has no recording."""
    context = _context(record, results)
    return () if context is None else tuple(context.fleet.names)


def _compared(tried: NotWorse, records: Sequence[Record]) -> str:
    judged, other = (records[place] for place in tried.places)
    name = tried.column.name
    if judged["metrics"].get(name) is None or other["metrics"].get(name) is None:
        return f"{judged['status']}: {(judged.get('error') or {}).get('message', '')}"
    mine, theirs = judged["metrics"][name], other["metrics"][name]
    worse = -direction(tried.column) * (mine / theirs - 1)
    return f"{name} is {mine:.4g} against {theirs:.4g}, {worse:.0%} worse"


def _contact(record: Record, results: Results) -> str:
    with_recording = _opened(record, results)
    if with_recording is None:
        return "a contact, of which there is no recording"
    try:
        context = with_recording.first_context()
        at, pairs = with_recording.channel("contact_time"), with_recording.channel("contact")
        if not len(at):
            return "a contact"
        robot, other = pairs[0].tolist()
        names = context.fleet.names
        time, truth = with_recording.channel("time"), with_recording.channel("truth")
        x, y = truth[int(abs(time - at[0]).argmin()), robot, :2].tolist()
    finally:
        with_recording.close()
    things = ("a wall", *names, *(f"a {mover.kind}" for mover in context.movers))
    touched = things[other + 1]
    return f"{names[robot]} touches {touched} at {at[0]:.1f} s, at ({x:.2f}, {y:.2f})"


def _context(record: Record, results: Results) -> RunContext | None:
    recording = _opened(record, results)
    if recording is None:
        return None
    try:
        return recording.first_context()
    except InputError:  # the plan of the run is not one
        return None
    finally:
        recording.close()


def _opened(record: Record, results: Results) -> Recording | None:
    try:
        return results.recording(record["run_id"])
    except InputError:
        return None
