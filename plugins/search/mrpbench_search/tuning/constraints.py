"""Constraints of a tuning, such as `succeeded>=base` or `execution.min_clearance_m>=base-0.02`."""

import re
from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.suggestions import did_you_mean
from mrpbench_search.tuning.parameters import NUMBER

_TEXT = re.compile(rf"\s*([\w./@-]+?)\s*([<>])=\s*(?:(base)\s*([+-]\s*{NUMBER})?|([+-]?\s*{NUMBER}))\s*")
ALWAYS = ("succeeded>=base", "execution.robot_contacts<=base", "execution.wall_contacts<=base")
"""Constraints that hold without being named, as far as the study measures their columns."""


@attrs.frozen(kw_only=True)
class Constraint:
    """A bound on the mean of a column."""

    text: str
    column: str
    at_least: bool
    bound: float
    """Added to the mean of the defaults if `relative`."""
    relative: bool

    def excess(self, value: float, base: float) -> float:
        """Return by how much a mean is beyond the bound; not above 0 if the constraint holds.

        Args:
            value: mean of the column; NaN = not known, which is beyond the bound.
            base: mean of the column with the defaults, over the same seeds.
        """
        if not np.isfinite(value):
            return 1.0
        bound = self.bound + (base if self.relative and np.isfinite(base) else 0.0)
        return float(bound - value if self.at_least else value - bound)


def read_constraints(texts: Sequence[str], columns: Mapping[str, object]) -> list[Constraint]:
    """Read constraints, and add those that always hold.

    Raises:
        InputError: a text is not a constraint, or names a column that the study does not have.
    """
    found = [_read(text) for text in texts]
    for each in found:
        if each.column not in columns and each.column != "succeeded":
            hint = did_you_mean(each.column, list(columns))
            raise InputError(f"--subject-to {each.text}: the study has no column {each.column}", hint=hint)
    named = {each.column for each in found}
    added = [_read(text) for text in ALWAYS]
    known = {*columns, "succeeded"}
    return [*(each for each in added if each.column in known and each.column not in named), *found]


def _read(text: str) -> Constraint:
    found = _TEXT.fullmatch(text)
    if found is None:
        raise InputError(
            f"--subject-to {text}: is not a constraint",
            hint="e.g. `succeeded>=base`, `execution.min_clearance_m>=base-0.02` or `tasks.late<=0`",
        )
    bound = float((found[4] or found[5] or "0").replace(" ", ""))
    return Constraint(
        text=text.replace(" ", ""), column=found[1], at_least=found[2] == ">", bound=bound, relative=bool(found[3])
    )
