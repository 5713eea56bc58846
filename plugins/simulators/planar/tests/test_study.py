"""The whole pipeline on this simulator."""

import zipfile

import pytest

import mrpbench_core

STUDY = {
    "world": "office",
    "roadmap": "lanes",
    "scenario": {"plugin": "random", "robots": 3},
    "fleet": "turtlebot3_burger",
    "assigner": "identity",
    "planner": "example",
    "controller": "pure_pursuit",
    "simulator": {"plugin": "planar", "slip": 0.02, "actuation_noise": 0.05},
    "metrics": [],
    "limits": {"execution": "5 s"},
    "matrix": {"seed": "0..1"},
}


def recordings(out):
    """Every recorded array, byte for byte."""
    parts = {}
    for file in out.rglob("recordings/*.zip"):
        with zipfile.ZipFile(file) as archive:
            parts.update({(file.name, member): archive.read(member) for member in archive.namelist()})
    return parts


def test_recordings_are_the_same_at_any_number_of_workers(tmp_path):
    pytest.importorskip("mrpbench_controllers_pure_pursuit")
    for name, workers in (("one", 1), ("two", 2)):
        mrpbench_core.run(STUDY, out=tmp_path / name, workers=workers)
    one, two = recordings(tmp_path / "one"), recordings(tmp_path / "two")
    assert len(one) > 40
    assert one == two
