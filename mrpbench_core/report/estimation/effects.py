"""Main effects: the levels of one factor compared, averaged over the combinations of all other factors.

Pairs have the scenario and the combination of the other factors in common, so neither confounds the comparison. The
differences of one scenario are averaged, because the scenario stays the sample. D. C. Montgomery, "Design and Analysis
of Experiments", chapter 5 (factorial designs with blocks).
"""

from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from mrpbench_core.model.common.arrays import Int
from mrpbench_core.report.estimation.groups import Setting, constant_axes, pooled
from mrpbench_core.report.reading.axes import Axes, factors, name_axes


@attrs.frozen(kw_only=True, eq=False)
class Effect:
    """The levels of a factor as the groups of a setting."""

    setting: Setting
    others: tuple[str, ...]
    """The combinations of the other factors that all levels have."""
    combined: dict[tuple[str, str], str]
    """The name of the group of the original setting, by level and combination."""


def find_effects(setting: Setting) -> list[Effect]:
    """Return the effect of each factor whose levels all have a combination of other factors in common.

    There is none if the groups of the setting differ in one factor only.
    """
    constant = constant_axes(setting.groups)
    choices = [
        factors({key: value for key, value in group.axes.items() if key not in constant}) for group in setting.groups
    ]
    named = dict.fromkeys(name for choice in choices for name in choice)
    varying = sorted(named, key=lambda name: name != "planner")  # of which most studies ask first
    if len(varying) < 2:
        return []
    return [effect for factor in varying for effect in _effect(setting, choices, factor, varying)]


def _effect(
    setting: Setting, choices: Sequence[dict[str, Axes]], factor: str, varying: Sequence[str]
) -> Iterator[Effect]:
    others = [name for name in varying if name != factor]
    table: dict[str, dict[str, int]] = {}
    for index, choice in enumerate(choices):
        rest = name_axes({key: value for name in others for key, value in choice.get(name, {}).items()})
        table.setdefault(name_axes(choice.get(factor, {})), {})[rest] = index
    common = [rest for rest in next(iter(table.values())) if all(rest in level for level in table.values())]
    if len(table) < 2 or not common:
        return
    over = f"averaged over {' and '.join(others)}" if len(common) > 1 else f"with {common[0]}"
    yield Effect(
        setting=Setting(
            name=f"{factor}, {over}",
            groups=tuple(pooled([setting.groups[level[rest]] for rest in common]) for level in table.values()),
            names=tuple(level or "none" for level in table),
            units=_units(setting, [[level[rest] for level in table.values()] for rest in common]),
            unit=setting.unit,
            cells=len(common),
        ),
        others=tuple(common),
        combined={
            (name or "none", rest): setting.names[level[rest]] for name, level in table.items() for rest in common
        },
    )


def _units(setting: Setting, cells: Sequence[Sequence[int]]) -> Int:
    """Number the pairs of sample and combination; `cells` has the groups of each combination."""
    units = setting.units * len(cells)
    for cell, groups in enumerate(cells):
        members = np.concatenate([setting.groups[index].members for index in groups])
        units[members] = setting.units[members] * len(cells) + cell
    return units
