"""Remarks of a loader, each once, with how often it applied."""

from collections import Counter


class Notes:
    """Collects remarks in order of first use."""

    def __init__(self) -> None:
        self._counts: Counter[str] = Counter()

    def add(self, sentence: str, times: int = 1) -> None:
        """Remark `sentence` (without its full stop) `times` more times."""
        if times:
            self._counts[sentence] += times

    def sentences(self) -> tuple[str, ...]:
        """The remarks as sentences."""
        return tuple(text + (f" ({times} times)." if times > 1 else ".") for text, times in self._counts.items())
