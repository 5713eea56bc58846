"""The scans of a control period, which are read when they are first needed: a simulator may still be taking them."""

from collections.abc import Callable, Sequence
from typing import Any

from mrpbench_core.model.execution.observation import ScanBatch


class Scans(Sequence[ScanBatch]):
    """The scans that `read` returns; it is called once."""

    def __init__(self, read: Callable[[], tuple[ScanBatch, ...]]) -> None:
        self._read = read
        self._batches: tuple[ScanBatch, ...] | None = None

    @property
    def batches(self) -> tuple[ScanBatch, ...]:
        """All of them."""
        if self._batches is None:
            self._batches = self._read()
        return self._batches

    def __getitem__(self, index: Any) -> Any:
        return self.batches[index]

    def __len__(self) -> int:
        return len(self.batches)
