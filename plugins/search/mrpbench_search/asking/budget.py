"""How much a search may cost: wall time, or runs."""

import math
import re
import time

import attrs

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.common.units import quantity

_RUNS = re.compile(r"([1-9]\d{0,8}) ?runs?")


@attrs.define
class Budget:
    """The limits of one search.

    Runs that are recorded already count as runs, so that a search with a budget in runs gives the same answer when it
    is repeated. Wall time is that of this invocation.
    """

    wall_s: float = math.inf
    runs: float = math.inf
    _began: float = attrs.field(factory=time.monotonic, init=False)

    def allows(self, runs: int, further_s: float) -> bool:
        """Tell whether a next step fits.

        Args:
            runs: that the search has asked for after this step, recorded or not.
            further_s: expected wall time of the step, in seconds.
        """
        return runs <= self.runs and time.monotonic() - self._began + further_s <= self.wall_s


def read_budget(text: str | None) -> Budget:
    """Read `10 min`, `2 h` or `300 runs`; without a text nothing is limited.

    Raises:
        InputError: it is neither a time nor a number of runs.
    """
    if text is None:
        return Budget()
    if match := _RUNS.fullmatch(text.strip()):
        return Budget(runs=int(match[1]))
    try:
        wall_s = quantity(text, "s")
    except ValueError:
        wall_s = 0.0
    if wall_s <= 0:
        raise InputError(
            f"--budget {text}: expected a time or a number of runs", hint="e.g. `10min`, `2h` or `300runs`"
        )
    return Budget(wall_s=wall_s)
