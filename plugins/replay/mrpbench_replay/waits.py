"""Packs why robots wait."""

from collections.abc import Sequence

from mrpbench_core.model.runs.plans import RecordedPlan
from mrpbench_core.model.runs.waits import explain_waits
from mrpbench_core.store.recording import Recording
from mrpbench_replay.packing import Packing


def pack_waits(recording: Recording, plans: Sequence[RecordedPlan], packing: Packing) -> None:
    """Pack `reason` and `culprit` if the recording allows to find them; see `explain_waits`."""
    waits = explain_waits(recording.first_context(), recording.channels, plans)
    if waits is not None:
        packing.add("reason", waits.reason.T)
        packing.add("culprit", waits.culprit.T)
