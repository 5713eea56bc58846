"""Notes of a loader, each once with the number of times that it applied."""

from collections import Counter


class Notes:
    """Collects notes in order of first use."""

    def __init__(self) -> None:
        self._counts: Counter[str] = Counter()

    def add(self, sentence: str, times: int = 1) -> None:
        """Add `sentence`, without its full stop, `times` times."""
        if times:
            self._counts[sentence] += times

    def sentences(self) -> tuple[str, ...]:
        """Return the notes as sentences."""
        return tuple(text + (f" ({times} times)." if times > 1 else ".") for text, times in self._counts.items())
