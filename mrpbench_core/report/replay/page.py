"""Writes the page: markup, style, modules and data in one file that loads no other file."""

import base64
import html
import json
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.run import all_routes
from mrpbench_core.report.reading.columns import Columns
from mrpbench_core.report.replay.doors import pack_facilities
from mrpbench_core.report.replay.events import read_contacts, read_events
from mrpbench_core.report.replay.facts import facts_of
from mrpbench_core.report.replay.motion import pack_motion
from mrpbench_core.report.replay.packing import Packing
from mrpbench_core.report.replay.scans import pack_scans
from mrpbench_core.report.replay.scene import pack_resources, pack_robots, pack_world
from mrpbench_core.report.replay.schedule import pack_schedule
from mrpbench_core.report.replay.waits import pack_waits
from mrpbench_core.store.recording import Recording


def write_page(
    recording: Recording,
    record: Mapping[str, Any],
    file: Path,
    *,
    columns: Columns | None = None,
    planner: str = "",
) -> None:
    """Write one run as a self-contained HTML page.

    Args:
        recording: with at least `time` and `truth` (or `estimate`).
        record: the run's record.
        file: the page.
        columns: descriptions of its metrics and timing.
        planner: name of the planner on the page.

    Raises:
        InputError: nothing was recorded, or the file cannot be written.
    """
    context = recording.context()
    motion, scans = Packing(), Packing()
    pack_motion(recording, motion)
    pack_schedule(recording.first_context(), motion)
    pack_waits(recording, record.get("config") or {}, motion)
    thinned = pack_scans(recording, scans)
    data = {
        "facts": facts_of(record, columns or {}, planner),
        "world": pack_world(context.world, motion)
        | pack_facilities(recording, context.world, motion)
        | {"resources": pack_resources(context.problem.roadmap)},
        "robots": pack_robots(context, motion, all_routes(recording.first_context().routes, recording.channels)),
        "events": read_events(recording, context),
        "contacts": read_contacts(recording),
        "scans": thinned,
    }
    title = f"{context.world.name}: {record['run_id'][:12]}"
    try:
        file.write_text(_fill(title, data, {"motion": motion, "scans": scans}), encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", file=file) from None


def _fill(title: str, data: Mapping[str, Any], packings: Mapping[str, Packing]) -> str:
    """Fill the marks of the template; an import map of `data:` addresses connects the modules."""
    folder = resources.files(__package__) / "page"
    modules = {entry.name: entry.read_text(encoding="utf-8") for entry in folder.iterdir() if entry.name.endswith("js")}
    imports = {f"replay/{name}": _address(name, modules[name]) for name in sorted(modules)}
    blobs = [
        f'<script type="application/octet-stream" id="{name}" data-layout="{html.escape(json.dumps(packing.layout))}">'
        f"{packing.text()}</script>"
        for name, packing in packings.items()
        if packing.layout
    ]
    parts = {
        "title": html.escape(title),
        "style": (folder / "style.css").read_text(encoding="utf-8"),
        "imports": _json({"imports": imports}),
        "data": f'<script type="application/json" id="run">{_json(data)}</script>\n' + "\n".join(blobs),
    }
    text = (folder / "index.html").read_text(encoding="utf-8")
    for name, part in parts.items():
        text = text.replace(f"<!--{name}-->", part, 1)
    return text


def _address(name: str, code: str) -> str:
    named = f"{code}\n//# sourceURL=replay/{name}\n"
    return "data:text/javascript;base64," + base64.b64encode(named.encode()).decode()


def _json(data: Any) -> str:
    """Return JSON for a script element; NaN and infinity become null."""
    return json.dumps(_plain(data), ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not abs(value) < float("inf") else value
