"""The answer of a tuning: one sentence on held-out seeds, and what each parameter contributes."""

from collections.abc import Sequence
from typing import Any

import attrs

from mrpbench_core.api.metric import Column
from mrpbench_core.files.text import counted
from mrpbench_search.tuning.confirm import Comparison, Importance, Standing


@attrs.frozen(kw_only=True)
class Tuned:
    """One setting of the answer."""

    number: int
    """Of the trial."""
    setting: dict[str, Any]
    """Only what differs from the defaults and matters."""
    held_out: tuple[Comparison, ...]
    """The first is in the study's own conditions."""
    importances: tuple[Importance, ...] = ()
    files: dict[str, str] = attrs.field(factory=dict)


def sentence(
    name: str, found: Sequence[Tuned], objectives: Sequence[Column], seeds: int, tried: int, *, met: bool = True
) -> str:
    """Say by how much the best setting is better than the defaults on held-out seeds, or that this is not shown.

    Args:
        name: of the study.
        found: the best settings.
        objectives: columns that are to become better.
        seeds: number of held-out seeds.
        tried: number of settings that were tried, with the defaults.
        met: some setting meets the constraints on training seeds.
    """
    if not found:
        others = counted(tried - 1, "other setting")
        if tried < 2:
            return f"{name}: no setting but the defaults was tried"
        if not met:
            return f"{name}: neither the defaults nor any of {others} meet the constraints, on training seeds"
        return f"{name}: none of {others} is better than the defaults within the constraints, on training seeds"
    best = found[0]
    parts = [_said(compared, objectives, seeds) for compared in best.held_out]
    if len(objectives) > 1:
        parts = [f"{counted(len(found), 'setting')} of the Pareto front; the first: {parts[0]}", *parts[1:]]
    return f"{name}: {'; '.join(parts)}: {written(best.setting)}"


def standing_of(found: Tuned, objectives: Sequence[Column]) -> Standing:
    """Return what is shown of a setting: the worst of its comparisons by the first objective."""
    order = (Standing.REFUSED, Standing.WORSE, Standing.NOT_SHOWN, Standing.BETTER)
    return min((each.standing(objectives[0]) for each in found.held_out), key=order.index)


def written(setting: dict[str, Any]) -> str:
    """Write a setting as overrides of a study."""
    return " ".join(f"{key}={_value(value)}" for key, value in setting.items())


def importance_table(rows: Sequence[Importance]) -> tuple[list[str], list[list[Any]]]:
    """Return headings and cells."""
    cells = []
    for row in rows:
        loss = "none: all runs are the same" if row.loss is None else f"{row.loss:+.1%}"
        if row.low is not None:
            loss += f" [{row.low:+.1%}, {row.high:+.1%}]"
        shown = "not shown" if not row.shown else "the default is better" if (row.loss or 0) < 0 else "shown"
        cells.append([row.key, _value(row.value), _value(row.default), loss, shown])
    return ["parameter", "value", "default", "loss at its default", ""], cells


def comparison_rows(found: Sequence[Tuned], objectives: Sequence[Column]) -> tuple[list[str], list[list[Any]]]:
    """Return headings and cells of the held-out figures: one row for each setting, condition and objective."""
    cells = []
    for each in found:
        for compared in each.held_out:
            for place, column in enumerate(objectives):
                difference, share = compared.differences[place], compared.share(place)
                interval = "–" if share is None else f"{share[0]:+.1%} [{share[1]:+.1%}, {share[2]:+.1%}]"
                cells.append(
                    [
                        each.number,
                        compared.where or "held-out seeds",
                        column.name,
                        None if difference is None else f"{difference.first:.4g}",
                        None if difference is None else f"{difference.second:.4g}",
                        interval,
                        compared.standing(column, place),
                    ]
                )
    return ["setting", "where", "metric", "defaults", "tuned", "difference", ""], cells


def document(found: Sequence[Tuned], objectives: Sequence[Column]) -> list[dict[str, Any]]:
    """Return the settings as JSON."""
    return [
        {
            "setting": each.setting,
            "trial": each.number,
            "held_out": [
                {
                    "where": compared.where,
                    "success": compared.success,
                    "broken": compared.broken,
                    "metrics": {
                        column.name: {
                            "standing": compared.standing(column, place),
                            "difference": compared.share(place),
                            "pairs": 0 if (pair := compared.differences[place]) is None else pair.difference.n,
                        }
                        for place, column in enumerate(objectives)
                    },
                }
                for compared in each.held_out
            ],
            "importance": [attrs.asdict(row) for row in each.importances],
            "files": each.files,
        }
        for each in found
    ]


def _said(compared: Comparison, objectives: Sequence[Column], seeds: int) -> str:
    where = f"on {seeds} held-out seeds" + (f" with {compared.where}" if compared.where else "")
    if compared.broken:
        return f"refused {where}, where the setting breaks {', '.join(compared.broken)}"
    parts = []
    for place, column in enumerate(objectives):
        share, standing = compared.share(place), compared.standing(column, place)
        name = column.name
        if share is None:
            parts.append(f"not shown: too few runs give {name}")
            continue
        value, low, high = share
        interval = f"[{low:+.1%}, {high:+.1%}]"
        if standing is Standing.NOT_SHOWN:
            parts.append(f"not shown: {name} {value:+.1%} {interval}")
        else:
            parts.append(f"{name} is {abs(value):.1%} {'less' if value < 0 else 'more'} {interval}")
    return f"{', '.join(parts)} {where}"


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.4g}" if isinstance(value, float) else str(value)
