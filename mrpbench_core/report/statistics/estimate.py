"""An estimate with its interval."""

from statistics import NormalDist

import attrs

LEVEL = 0.95
"""Confidence level of all intervals."""
Z = NormalDist().inv_cdf((1 + LEVEL) / 2)
"""Half the width of a normal interval, in standard errors."""


@attrs.frozen
class IntervalEstimate:
    """A rate or a mean over units, with its interval."""

    value: float
    low: float
    high: float
    """Ends of the interval; NaN if there are too few units."""
    n: int
    """Number of units: scenarios, or runs if there is only one scenario."""

    @property
    def has_interval(self) -> bool:
        """True if there is an interval."""
        return self.low == self.low and self.high == self.high
