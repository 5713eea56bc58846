"""A DDS domain of each test, on this machine alone."""

import os

import pytest

LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo'/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><Peers><Peer address='127.0.0.1'/></Peers>"
    "<ParticipantIndex>auto</ParticipantIndex></Discovery></Domain></CycloneDDS>"
)


@pytest.fixture
def domain(monkeypatch):
    monkeypatch.setenv("CYCLONEDDS_URI", LOOPBACK)
    return 1 + os.getpid() % 200
