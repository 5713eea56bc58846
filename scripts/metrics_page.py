"""Print `docs/reference/metrics/index.md` from the columns of the metrics: `python scripts/metrics_page.py`."""

import importlib
import inspect
import tomllib
from pathlib import Path

from mrpbench_core.api import Column

HEAD = """\
# Metrics
`scripts/metrics_page.py` writes this page from the descriptions of the metrics. `planning` and `execution` are
measured by default. A configuration names other metrics, with options where the defaults do not fit:
```yaml
metrics: [planning, execution, delay, {plugin: stops, least: 1 s}]
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


def page() -> str:
    """The page as Markdown."""
    project = Path(__file__).parents[1] / "plugins/pyproject.toml"
    entries = tomllib.loads(project.read_text())["project"]["entry-points"]["mrpbench.metrics"]
    parts = [HEAD]
    for name, where in sorted(entries.items()):
        module, _, attribute = where.partition(":")
        metric = getattr(importlib.import_module(module), attribute)
        parts += [f"\n## {name}\n{inspect.getdoc(metric)}\n"]
        if metric.requires:
            parts += [f"\nRequires {_words(metric.requires)}.\n"]
        parts += ["\n| column | unit | better | noticeable | definition |\n|---|---|---|---|---|\n"]
        for column in metric.columns:
            notes = f" (requires {_words(column.requires)})" if column.requires else ""
            notes += f" (formerly {_words(frozenset(column.aliases))})" if column.aliases else ""
            better = f"{column.better}, primary" if column.primary else column.better
            threshold = _threshold(column)
            source = f" [{column.source}]" if column.source else ""
            parts += [
                f"| `{column.name}` | {column.unit} | {better} | {threshold} | {column.description}{notes}{source} |\n"
            ]
    return "".join(parts)


def _threshold(column: Column) -> str:
    if column.threshold is None:
        return "–"
    return f"{column.threshold:g} {column.unit}".strip() + f", {column.threshold_share:.0%}" * bool(
        column.threshold_share
    )


def _words(required: frozenset[str]) -> str:
    return ", ".join(f"`{name}`" for name in sorted(required))


if __name__ == "__main__":
    print(page(), end="")
