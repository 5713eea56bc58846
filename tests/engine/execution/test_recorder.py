"""Sampling, chunks and channels that stay empty."""

import numpy as np
import pytest

from mrpbench_core.engine.execution.recorder import SAMPLES, SCANS, Recorder, Sample
from mrpbench_core.model.execution.motion import Event, Motion
from mrpbench_core.model.execution.observation import Estimate, Odometry, ScanBatch
from mrpbench_core.model.execution.orders import Orders
from mrpbench_core.model.execution.state import State


def feed(recorder, steps, period=0.05):
    pose = np.zeros((2, 3))
    state = State(pose=pose, twist=pose[:, :2], level=[0, 0], contacts=[])
    motion = Motion(twist=pose[:, :2], reached=[0, 0], cleared=[0, 0], mode=[0, 0])
    for step in range(steps + 1):
        sample = Sample(
            now=step * period,
            state=state,
            estimate=Estimate(pose=pose),
            odometry=Odometry(pose=pose, twist=pose[:, :2]),
            orders=Orders(released=[1, 1]),
            motion=motion,
            waits_for=np.full(2, -1, np.int32),
            facility=[0.5],
        )
        recorder.sample(step, sample, last=step == steps)
    recorder.flush()


def joined(chunks, name):
    return np.concatenate([chunk[name] for chunk in chunks if name in chunk])


def test_samples_are_taken_at_the_rate_and_at_both_ends():
    chunks = []
    feed(Recorder(10.0, 0.05, chunks.append), 7)
    np.testing.assert_allclose(joined(chunks, "time"), [0, 0.1, 0.2, 0.3, 0.35])
    assert joined(chunks, "odometry").shape == (5, 2, 5)


def test_chunks_are_handed_on_before_the_end():
    chunks = []
    feed(Recorder(20.0, 0.05, chunks.append), 3 * SAMPLES)
    assert max(len(chunk.get("time", ())) for chunk in chunks) == SAMPLES
    assert len(joined(chunks, "time")) == 3 * SAMPLES + 1


def test_contacts_and_events_are_channels_even_when_nothing_happened():
    chunks = []
    feed(Recorder(10.0, 0.05, chunks.append), 1)
    assert joined(chunks, "contact").shape == (0, 2)
    assert len(joined(chunks, "event_kind")) == 0


def test_contacts_events_and_scans_of_unlike_lidars_are_kept():
    chunks = []
    recorder = Recorder(10.0, 0.05, chunks.append)
    still = State(pose=np.zeros((2, 3)), twist=np.zeros((2, 2)), level=[0, 0], contacts=[[0, 1], [1, -1]])
    recorder.contacts(0.5, still)
    recorder.events((Event(stamp=0.5, kind="spin", robot=1, detail="left"),))
    recorder.scans(
        (ScanBatch(stamp=0.2, robot=[0], ranges=[[1, 2]]), ScanBatch(stamp=0.4, robot=[1], ranges=[[3, 4, np.inf]]))
    )
    recorder.flush()
    assert joined(chunks, "contact").tolist() == [[0, 1], [1, -1]]
    assert joined(chunks, "event_detail").tolist() == ["robot_1", "wall", "left"]
    np.testing.assert_array_equal(joined(chunks, "scan_ranges"), [[1, 2, np.nan], [3, 4, np.inf]])


def test_a_contact_is_an_event_when_it_begins():
    chunks = []
    recorder = Recorder(10.0, 0.05, chunks.append)
    for period, contacts in enumerate(([[0, 1]], [[0, 1]], [], [[0, 1], [0, -1]])):
        state = State(pose=np.zeros((2, 3)), twist=np.zeros((2, 2)), level=[0, 0], contacts=contacts)
        recorder.contacts(period * 0.05, state)
    recorder.flush()
    assert len(joined(chunks, "contact")) == 4
    assert joined(chunks, "event_kind").tolist() == ["contact"] * 3
    assert joined(chunks, "event_time").tolist() == pytest.approx([0, 0.15, 0.15])
    assert joined(chunks, "event_detail").tolist() == ["robot_1", "wall", "robot_1"]


def test_scans_of_many_robots_are_handed_on_before_the_end():
    chunks = []
    recorder = Recorder(10.0, 0.05, chunks.append)
    batch = ScanBatch(stamp=0.0, robot=np.arange(100), ranges=np.ones((100, 3)))
    for _ in range(2 * SCANS // 100 + 2):
        recorder.scans((batch,))
    recorder.flush()
    assert max(len(chunk.get("scan_time", ())) for chunk in chunks) < SCANS + 100
    assert len(joined(chunks, "scan_ranges")) == 100 * (2 * SCANS // 100 + 2)


def test_doors_and_lifts_are_a_channel_where_there_are_some():
    chunks = []
    feed(Recorder(10.0, 0.05, chunks.append), 1)
    assert joined(chunks, "facility").tolist() == [[0.5], [0.5]]
    assert joined(chunks, "waits_for").tolist() == [[-1, -1], [-1, -1]]


def test_changes_of_maps_are_handed_on_and_nothing_is_written_without_any():
    chunks = []
    recorder = Recorder(10.0, 0.05, chunks.append)
    count = len(chunks)
    recorder.maps({})
    assert len(chunks) == count
    changes = {"map_time": np.zeros(1), "map_cells": np.zeros((1, 2, 2), "i1")}
    recorder.maps(changes)
    assert chunks[count:] == [changes]


def test_scans_are_not_kept_unless_requested():
    chunks = []
    recorder = Recorder(10.0, 0.05, chunks.append, scans=False)
    recorder.scans((ScanBatch(stamp=0.0, robot=[0], ranges=[[1, 2]]),))
    recorder.flush()
    assert not any("scan_ranges" in chunk for chunk in chunks)
