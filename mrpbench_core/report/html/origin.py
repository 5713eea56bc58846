"""The section that says how to reproduce the results: versions, machines, configurations, files."""

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

import numpy as np

from mrpbench_core.files.text import counted
from mrpbench_core.report.reading.invocations import made_with, read_invocations
from mrpbench_core.report.report import Report
from mrpbench_core.report.statistics.means import RESAMPLES, SEED
from mrpbench_core.report.tables.spans import spans
from mrpbench_core.store.invocation import dumps
from mrpbench_core.store.run_files import digest
from mrpbench_core.version import __version__


def origin(report: Report) -> str:
    """Markup of the section."""
    invocations = read_invocations(report.folders)
    runs = report.runs
    facts = [
        ("seeds", spans(runs.seed)),
        ("repeats", spans(runs.repeat)),
        ("scenarios", str(len(np.unique(runs.scenario[runs.scenario >= 0])))),
        ("bootstrap", f"{RESAMPLES} resamples, seed {SEED}"),
        ("report made by", f"mrpbench {__version__}"),
        *((name, ", ".join(values)) for name, values in made_with(invocations).items()),
    ]
    items = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in facts)
    return f'<dl class="facts">{items}</dl>{_invocations(invocations)}{_studies(invocations)}{_shards(report)}'


def _invocations(invocations: Iterable[dict[str, Any]]) -> str:
    rows = []
    for entry in invocations:
        machine = entry.get("machine") or {}
        words = " ".join(map(str, entry.get("overrides") or ()))
        size = machine.get("memory_bytes")
        memory = f"{size / 2**30:.0f} GiB" if isinstance(size, int | float) else "memory unknown"
        cells = (
            entry.get("started"),
            machine.get("node"),
            f"{machine.get('processor')}, {counted(machine.get('cores', 0), 'core')}, {memory}",
            machine.get("system"),
            machine.get("python"),
            words,
        )
        rows.append("".join(f"<td>{escape(str(cell or '–'))}</td>" for cell in cells))
    if not rows:
        return "<p>The folders contain no invocations, so the versions and the machine are unknown.</p>"
    heads = "".join(f"<th>{name}</th>" for name in ("started", "node", "machine", "system", "Python", "overrides"))
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return f'<div class="wide"><table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table></div>'


def _studies(invocations: Sequence[dict[str, Any]]) -> str:
    """Each different configuration as YAML that `mrpbench run` takes."""
    texts = dict.fromkeys(dumps(entry["study"]) for entry in invocations if entry.get("study"))
    return "".join(
        f"<details><summary>Configuration{f' {number}' if len(texts) > 1 else ''}: save it as <code>study.yaml</code>"
        f" and <code>mrpbench run study.yaml</code></summary><pre>{escape(text)}</pre></details>"
        for number, text in enumerate(texts, start=1)
    )


def _shards(report: Report) -> str:
    rows = [
        f"<tr><td>{escape(str(shard))}</td><td><code>{digest(shard)}</code></td></tr>"
        for results in report.folders
        for shard in results.folder.shards()
        if shard.is_file()
    ]
    damaged = [error for results in report.folders for error in results.damaged]
    warning = "".join(f'<p class="warning">{escape(str(error))}</p>' for error in damaged)
    return (
        f"<details><summary>{counted(len(rows), 'file')} of records, with SHA-256</summary>"
        f'<div class="wide"><table><tbody>{"".join(rows)}</tbody></table></div></details>{warning}'
    )
