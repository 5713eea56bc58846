"""Write `docs/reference/metrics/`, a page for each stage, from the columns of the metrics.

Command: `python scripts/metrics_page.py`.
"""

import importlib
import inspect
import tomllib
from pathlib import Path

from mrpbench_core.api import Column, Metric

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "docs/reference/metrics"
STAGES = {
    "planning": ("Planning", ("planning",)),
    "dispatching": ("Dispatching", ("delay", "draws", "waiting", "deadlock")),
    "localization": ("Localisation", ("localization",)),
    "control": ("Control and safety", ("clearance", "contact", "smoothness", "stops", "tracking", "barn")),
    "execution": ("Execution as a whole", ("execution", "throughput", "efficiency", "energy", "fairness")),
    "tasks": ("Tasks over time", ("tasks",)),
    "people": ("People", ("people",)),
}
"""Pages with their titles and metrics: the stage of a run that decides what they measure."""
WRITTEN = "*`scripts/metrics_page.py` writes this page from the descriptions of the metrics.*\n"
INDEX = f"""\
# Metrics
{WRITTEN}
`planning` and `execution` are measured by default, and sections add their own: `tasks` adds `tasks`, `crowds` adds
`people`, `delays` and `faults` add `delay` where there are no tasks, and `delays.draws` adds `draws`. A configuration
names other metrics, with options where the defaults do not fit:
```yaml
metrics: [planning, execution, delay, {{plugin: stops, least: 1 s}}]
```
In records and tables a column is called `<metric>.<column>`. Times are simulated seconds, never wall time. A value
that cannot be measured is null, never zero. `Requires` names the data without which a metric, or one of its columns,
is null: channels of the recording (see [results folder](../results-folder.md)), `plan` (a plan exists), `path` (the
path that each robot was to follow is known) or `end` (how the run ended is known). Samples are
taken at `recording.rate`, so times are exact to one sample.
Tables, figures and replays show the columns marked *primary* unless others are asked for (`--metrics`).
Reports call a difference of two means *noticeable* if it reaches the threshold in the column `noticeable`, which the
metric declares: an amount, and in some cases also a share of the larger mean. Both must then be reached.
"""


def pages() -> dict[str, str]:
    """The pages as Markdown, by name of the file."""
    project = ROOT / "plugins/pyproject.toml"
    entries = tomllib.loads(project.read_text())["project"]["entry-points"]["mrpbench.metrics"]
    listed = [name for _, names in STAGES.values() for name in names]
    if sorted(listed) != sorted(entries):
        raise SystemExit(f"each metric belongs to one stage in STAGES: {sorted(set(listed) ^ set(entries))}")
    metrics = {name: _load(where) for name, where in entries.items()}
    index = [INDEX, "\n| stage | metric | description |\n|---|---|---|\n"]
    found = {}
    for page, (title, names) in STAGES.items():
        for number, name in enumerate(names):
            first = f"[{title}]({page}.md)" if number == 0 else ""
            index.append(f"| {first} | [`{name}`]({page}.md#{name}) | {_summary(metrics[name])} |\n")
        found[f"{page}.md"] = "".join([f"# {title}\n{WRITTEN}", *(_section(name, metrics[name]) for name in names)])
    toctree = "\n".join(STAGES)
    return {"index.md": "".join([*index, f"\n```{{toctree}}\n:hidden:\n\n{toctree}\n```\n"]), **found}


def _load(where: str) -> type[Metric]:
    module, _, attribute = where.partition(":")
    metric: type[Metric] = getattr(importlib.import_module(module), attribute)
    return metric


def _summary(metric: type[Metric]) -> str:
    return (inspect.getdoc(metric) or "").partition("\n\n")[0].replace("\n", " ")


def _section(name: str, metric: type[Metric]) -> str:
    parts = [f"\n## {name}\n{inspect.getdoc(metric)}\n"]
    if metric.requires:
        parts += [f"\nRequires {_words(metric.requires)}.\n"]
    parts += ["\n| column | unit | better | noticeable | definition |\n|---|---|---|---|---|\n"]
    return "".join(parts + [_row(column) for column in metric.columns])


def _row(column: Column) -> str:
    notes = f" (requires {_words(column.requires)})" if column.requires else ""
    notes += f" (formerly {_words(frozenset(column.aliases))})" if column.aliases else ""
    better = f"{column.better}, primary" if column.primary else column.better
    source = f" [{column.source}]" if column.source else ""
    definition = f"{column.description}{notes}{source}"
    return f"| `{column.name}` | {column.unit} | {better} | {_threshold(column)} | {definition} |\n"


def _threshold(column: Column) -> str:
    if column.threshold is None:
        return "–"
    return f"{column.threshold:g} {column.unit}".strip() + f", {column.threshold_share:.0%}" * bool(
        column.threshold_share
    )


def _words(required: frozenset[str]) -> str:
    return ", ".join(f"`{name}`" for name in sorted(required))


if __name__ == "__main__":
    for name, text in pages().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
