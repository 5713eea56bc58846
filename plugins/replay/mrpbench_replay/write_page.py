"""Writes the page: markup, style, modules and data in one file that loads no other file."""

import base64
import html
import json
from collections.abc import Mapping
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from mrpbench_core.model.runs.plans import read_plans
from mrpbench_core.report.reading.columns import Columns
from mrpbench_core.report.template import PageTemplate
from mrpbench_core.store.recording import Recording
from mrpbench_replay.doors import pack_facilities
from mrpbench_replay.events import read_contacts, read_events
from mrpbench_replay.facts import facts_of
from mrpbench_replay.maps import pack_maps
from mrpbench_replay.motion import pack_motion
from mrpbench_replay.movers import pack_movers
from mrpbench_replay.packing import Packing
from mrpbench_replay.scans import pack_scans
from mrpbench_replay.scene import pack_resources, pack_robots, pack_world
from mrpbench_replay.schedule import pack_schedule
from mrpbench_replay.tasks import pack_tasks
from mrpbench_replay.trajectories import pack_trajectories
from mrpbench_replay.waits import pack_waits

FOLDER = resources.files(__package__) / "page"


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
    motion, scans, trajectories, maps = Packing(), Packing(), Packing(), Packing()
    pack_motion(recording, motion)
    plans = read_plans(recording.first_context(), recording.channels)
    pack_schedule(plans, context.problem.roadmap.tick, motion)
    pack_waits(recording, plans, motion)
    pack_tasks(recording, motion)
    thinned = pack_scans(recording, scans)
    data = {
        "facts": facts_of(record, columns or {}, planner),
        "world": pack_world(context.world, motion)
        | pack_facilities(recording, context.world, motion)
        | {"resources": pack_resources(context.problem.roadmap)},
        "robots": pack_robots(context, motion, plans),
        "events": read_events(recording, context, plans),
        "contacts": read_contacts(recording),
        "movers": pack_movers(recording, motion),
        "scans": thinned,
        "trajectories": pack_trajectories(recording, trajectories),
        "maps": pack_maps(recording, maps),
    }
    title = f"{context.world.name}: {record['run_id'][:12]}"
    packings = {"motion": motion, "scans": scans, "trajectories": trajectories, "maps": maps}
    template().write(file, title, {"data": _data(data, packings)})


@cache
def template() -> PageTemplate:
    """The template of replays; an import map of `data:` addresses connects the modules."""
    modules = {entry.name: entry.read_text(encoding="utf-8") for entry in FOLDER.iterdir() if entry.name.endswith("js")}
    imports = {f"replay/{name}": _address(name, modules[name]) for name in sorted(modules)}
    style = (FOLDER / "style.css").read_text(encoding="utf-8")
    return PageTemplate(FOLDER / "index.html", {"style": style, "imports": _json({"imports": imports})})


def _data(data: Mapping[str, Any], packings: Mapping[str, Packing]) -> str:
    """Return the elements that hold the data."""
    blobs = [
        f'<script type="application/octet-stream" id="{name}" data-layout="{html.escape(json.dumps(packing.layout))}">'
        f"{packing.text()}</script>"
        for name, packing in packings.items()
        if packing.layout
    ]
    return f'<script type="application/json" id="run">{_json(data)}</script>\n' + "\n".join(blobs)


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
