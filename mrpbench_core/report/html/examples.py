"""The section with runs to look at: pictures, and links to replays."""

from collections.abc import Mapping, Sequence
from html import escape

from mrpbench_core.files.errors import InputError
from mrpbench_core.report.answer.examples import Example, Examples
from mrpbench_core.report.pictures.thumbnail import run_thumbnail, world_thumbnail
from mrpbench_core.report.report import Report


def examples_section(
    report: Report, examples: Sequence[Examples], replays: Mapping[str, str], pairs: Mapping[tuple[str, str], str]
) -> str:
    """Return the section; a picture whose recording is damaged is left out.

    Args:
        report: of the runs.
        examples: runs of some settings.
        replays: addresses of pages, relative to the report, by run id.
        pairs: the same of pages with two runs side by side.
    """
    if not examples:
        return (
            "<h2>Runs to look at</h2><p>No run has a recording, so there are no pictures and replays. Runs are recorded"
            " if they are executed and <code>recording: {keep: all}</code> is set, the default.</p>"
        )
    parts = "".join(_setting(report, entry, replays, pairs) for entry in examples)
    key = "Dot: start. Cross: where the robot ended. Ring: its goal."
    return f'<h2>Runs to look at</h2>{parts}<p class="note">{key}</p>'


def _setting(
    report: Report, examples: Examples, replays: Mapping[str, str], pairs: Mapping[tuple[str, str], str]
) -> str:
    title = f"<h3>{escape(examples.name)}</h3>" if examples.name else ""
    cards = [_world(report, examples.runs[0]), *(_card(report, example, replays) for example in examples.runs)]
    contrast = ""
    if pair := examples.contrast:
        ids = (report.runs.run_id[pair.first], report.runs.run_id[pair.second])
        words = f"{escape(pair.text)}."
        if ids in pairs:
            contrast = f'<p>{words} <a href="{escape(pairs[ids])}">Why? Both replays side by side</a></p>'
        else:
            contrast = f"<p>{words}</p>"
    return f'{title}<div class="examples">{"".join(cards)}</div>{contrast}'


def _world(report: Report, example: Example) -> str:
    return f"<figure>{_picture(report, example.run, world=True)}<figcaption>the world</figcaption></figure>"


def _card(report: Report, example: Example, replays: Mapping[str, str]) -> str:
    picture = _picture(report, example.run)
    words = f"<b>{escape(example.label)}</b> {escape(example.text)}"
    address = replays.get(report.runs.run_id[example.run])
    if address:
        picture, words = (f'<a href="{escape(address)}">{part}</a>' for part in (picture, words))
    return f"<figure>{picture}<figcaption>{words}</figcaption></figure>"


def _picture(report: Report, run: int, *, world: bool = False) -> str:
    results = report.folders[int(report.runs.folder[run])]
    try:
        recording = results.recording(report.runs.run_id[run])
        try:
            return world_thumbnail(recording) if world else run_thumbnail(recording)
        finally:
            recording.close()
    except InputError:
        return "<p>damaged recording</p>"
