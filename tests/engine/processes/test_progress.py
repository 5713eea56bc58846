"""A slot keeps what the run in it says about its progress."""

from pathlib import Path

from mrpbench_core.engine.processes.job import Job
from mrpbench_core.engine.processes.slot import Slot
from mrpbench_core.engine.record import RunRecord
from mrpbench_core.store.paths import RunPaths

FACTS = {"simulated_s": 3.0, "limit_s": 60.0, "arrived": 1, "robots": 2}


class Scripted:
    """A child that says these messages."""

    def __init__(self, slot, *messages):
        self.slot, self.messages, self.seen = slot, list(messages), []

    def send(self, message):
        assert message["run_id"] == "r"

    def receive(self, timeout):
        assert timeout > 60
        self.seen.append(self.slot.progress)
        return self.messages.pop(0)


def test_progress_is_that_of_the_execution_under_way(tmp_path, monkeypatch):
    slot = Slot()
    end = {"record": RunRecord(run_id="r").message()}
    child = Scripted(slot, {"progress": None}, {"progress": FACTS}, {"progress": None}, end)
    monkeypatch.setattr(slot, "_ready", lambda: child)
    paths = RunPaths(recording=tmp_path / "r", exports=tmp_path / "e", picture=None)
    job = Job(
        run_id="r", parcel={}, facts={}, keep="all", paths=paths, log=Path("log"), wall_s=60.0, memory_bytes=2**30
    )
    assert slot.run(job).record.run_id == "r"
    assert child.seen == [None, None, {"run_id": "r", **FACTS}, None]
    assert slot.progress is None
