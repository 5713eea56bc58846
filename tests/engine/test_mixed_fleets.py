"""Robots of unlike sizes and speeds, from the plan to the last goal."""

import numpy as np
import pytest

import mrpbench_core
from mrpbench_core.store.recording import Recording

NAMES = ("turtlebot3_burger", "turtlebot3_waffle", "agv_600")
STUDY = {
    "roadmap": "lanes",
    "assigner": "identity",
    "metrics": ["planning", "execution"],
    "limits": {"execution": "250 s", "planning": "30 s"},
}


@pytest.fixture(autouse=True)
def _plugins():
    for name in ("planners_mapf", "simulators_planar", "controllers_pure_pursuit", "metrics_standard"):
        pytest.importorskip(f"mrpbench_{name}")


def driven(out, counts, **changes):
    """A run of so many robots of each kind, with room for what driving errs."""
    fleet = [{"robot": name, "count": count, "margin": 0.05} for name, count in zip(NAMES, counts, strict=True)]
    study = {**STUDY, "scenario": {"plugin": "random", "robots": sum(counts)}, "fleet": fleet, **changes}
    (record,) = mrpbench_core.run(study, out=out)
    assert record["status"] == "succeeded", record.get("error")
    (file,) = out.rglob("recordings/*.zip")
    recording = Recording(file)
    context = recording.context()
    speed = np.abs(recording.channel("truth_twist")[:, :, 0]).max(axis=0)
    recording.close()
    return record["metrics"], context, speed


@pytest.mark.parametrize(
    ("world", "planner", "simulator", "counts"),
    [
        ("office", "prioritized", "planar", (2, 2, 1)),
        ("office", "cbs", "planar", (1, 1, 1)),
        ("warehouse", "prioritized", {"plugin": "pybullet", "model": "body"}, (2, 2, 1)),
        ("office", "cbs", "pybullet", (1, 1, 1)),
    ],
)
def test_they_plan_and_drive_without_a_contact(tmp_path, world, planner, simulator, counts):
    if simulator != "planar":
        pytest.importorskip("pybullet")
    metrics, context, speed = driven(tmp_path, counts, world=world, planner=planner, simulator=simulator)
    assert metrics["execution.robot_contacts"] == 0
    assert metrics["execution.wall_contacts"] == 0
    assert metrics["execution.goals_reached"] == sum(counts)
    robots = context.fleet.robots
    assert [robot.name for robot in robots] == [
        name for name, count in zip(NAMES, counts, strict=True) for _ in range(count)
    ]
    assert len(set(context.problem.profile.tolist())) == 3
    assert np.allclose(context.problem.radius, [robot.radius + 0.05 for robot in robots])
    assert (speed <= np.array([robot.max_speed for robot in robots]) * 1.01).all()
    assert speed[-1] > 0.3  # none of the others can
