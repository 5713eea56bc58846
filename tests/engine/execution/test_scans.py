"""Scans are read once, when they are first needed."""

import numpy as np

from mrpbench_core.engine.execution.scans import Scans
from mrpbench_core.model.execution.observation import ScanBatch

BATCHES = tuple(ScanBatch(stamp=at, robot=np.arange(2), ranges=np.full((2, 4), at)) for at in (0.5, 1.0))


def test_scans_are_read_when_they_are_needed_and_only_once():
    reads = []
    scans = Scans(lambda: reads.append(1) or BATCHES)
    assert not reads
    assert len(scans) == 2
    assert [batch.stamp for batch in scans] == [0.5, 1.0]
    assert scans[-1] is BATCHES[1]
    assert scans.batches is BATCHES
    assert len(reads) == 1


def test_no_scans_are_none():
    assert not Scans(tuple)
