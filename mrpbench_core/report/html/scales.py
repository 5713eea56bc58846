"""Axes of charts: positions of values, and ticks."""

import math

import attrs
import numpy as np


@attrs.frozen
class Scale:
    """Maps values to pixels."""

    low: float
    high: float
    start: float
    """Pixel of `low`."""
    end: float
    log: bool = False

    def at(self, value: float) -> float:
        """Pixel of a value, within the axis."""
        if self.log:
            share = math.log(max(value, self.low) / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return self.start + min(1.0, max(0.0, share)) * (self.end - self.start)

    def ticks(self, count: int = 5) -> list[float]:
        """Return about `count` round values."""
        if self.log:
            first, last = math.ceil(math.log10(self.low) - 1e-9), math.floor(math.log10(self.high) + 1e-9)
            step = max(1, math.ceil((last - first + 1) / (count + 1)))
            powers = [10.0**power for power in range(first, last + 1, step)]
            return powers if len(powers) > 1 else [self.low, self.high]
        rough = (self.high - self.low) / count
        step = 10 ** math.floor(math.log10(rough))
        step *= next(factor for factor in (1, 2, 2.5, 5, 10) if factor * step >= rough * 0.999)
        first = math.ceil(self.low / step - 1e-9)
        return [float(number * step) for number in range(first, math.floor(self.high / step + 1e-9) + 1)]


def spread(
    values: "list[float] | np.ndarray[tuple[int], np.dtype[np.float64]]", log: bool = False
) -> tuple[float, float]:
    """Return the ends of an axis for these values, with a margin."""
    low, high = float(np.min(values)), float(np.max(values))
    if log:
        return 10 ** math.floor(math.log10(low) + 1e-9), 10 ** max(
            math.ceil(math.log10(high) - 1e-9), math.floor(math.log10(low) + 1e-9) + 1
        )
    room = 0.06 * (high - low) or abs(high) * 0.1 or 1.0
    return (0.0 if 0 <= low < 0.3 * high else low - room), high + room


def tick_text(value: float) -> str:
    """A tick's label."""
    if value and (abs(value) < 1e-3 or abs(value) >= 1e5):
        return f"1e{math.log10(value):.0f}" if value > 0 and math.log10(value).is_integer() else f"{value:.0e}"
    return f"{value:g}"
