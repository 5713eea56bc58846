"""An estimate with its interval."""

import attrs

LEVEL = 0.95
"""Of all intervals."""


@attrs.frozen
class IntervalEstimate:
    """A rate or a mean over units, with its interval."""

    value: float
    low: float
    high: float
    """Ends of the interval; NaN where there are too few units for one."""
    n: int
    """Units it is over: scenarios, or runs where there is but one scenario."""

    @property
    def has_interval(self) -> bool:
        """Whether the ends are numbers."""
        return self.low == self.low and self.high == self.high
