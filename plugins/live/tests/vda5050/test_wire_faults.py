"""Messages are lost, doubled and late as often as asked for."""

import pytest
from mrpbench_live.vda5050.wire_faults import FaultyWire, WireFaults


class Cut:
    def __init__(self):
        self.cuts = []

    def cut(self, seconds):
        self.cuts.append(seconds)


def carried(**faults):
    wire, came = FaultyWire(WireFaults(**faults), Cut()), []
    for number in range(1000):
        wire.carry(lambda number=number: came.append(number))
    return wire, came


def test_without_faults_all_come_in_order():
    assert carried()[1] == list(range(1000))


def test_some_are_lost_and_some_come_twice():
    assert len(carried(lost=0.2)[1]) == pytest.approx(800, abs=50)
    assert len(carried(doubled=0.2)[1]) == pytest.approx(1200, abs=50)
    assert carried(lost=1.0)[1] == []


def test_late_ones_come_after_others():
    wire, came = carried(late=0.3, delay=0.0)
    before = len(came)
    assert before == pytest.approx(700, abs=50)
    wire.advance(0.0)
    assert sorted(came) == list(range(1000))
    assert came != sorted(came)


def test_connections_are_cut_at_intervals():
    cut = Cut()
    wire = FaultyWire(WireFaults(cut_every=10.0, cut_for=1.5), cut)
    assert [second for second in range(35) if wire.advance(float(second))] == [10, 20, 30]
    assert cut.cuts == [1.5] * 3
