"""The errors of estimates on the built-in worlds, in runs of the whole engine with noisy lidars and odometry.

The bounds are about one and a half times what was measured; `benchmarks/localizers.py` prints the figures.
"""

from functools import cache

import numpy as np
import pytest

import mrpbench_core
from mrpbench_core.store.recording import Recording

NOISE = {"lidar": 0.01, "lidar_dropout": 0.02, "odometry": 0.005, "odometry_bias": 0.002}
TUNED = {
    "plugin": "amcl",
    "laser_model_type": "likelihood_field_prob",
    **{f"alpha{index}": 0.02 for index in range(1, 5)},
}


def errors(out, world, localizer, **changes):
    """Distances f8[T,n] in metres of estimates from the truth, and the record."""
    study = {
        "world": world,
        "scenario": {"plugin": "random", "robots": 4},
        "assigner": "identity",
        "planner": "prioritized",
        "simulator": "planar",
        "localizer": localizer,
        "noise": NOISE,
        "control_rate": "10 Hz",
        "metrics": ["execution"],
        "limits": {"execution": "60 s"},
        "seed": 1,
        **changes,
    }
    (record,) = mrpbench_core.run(study, out=out)
    (file,) = out.rglob("recordings/*.zip")
    recording = Recording(file)
    off = recording.channel("estimate") - recording.channel("truth")
    recording.close()
    return np.hypot(off[..., 0], off[..., 1]), record


@pytest.fixture(autouse=True)
def _stack():
    pytest.importorskip("mrpbench_simulators_planar")
    pytest.importorskip("mrpbench_planners_mapf")
    pytest.importorskip("mrpbench_controllers_pure_pursuit")


@pytest.fixture(scope="module")
def drift(tmp_path_factory):
    """Return a function that says how far odometry alone is off at the end of a run in a world."""

    @cache
    def most(world):
        off, _ = errors(tmp_path_factory.mktemp("odometry"), world, "odometry")
        return off[-1].max()

    return most


@pytest.mark.parametrize(
    ("world", "localizer", "rms", "most"),
    [
        ("office", "amcl", 0.15, 0.4),
        ("office", TUNED, 0.05, 0.12),
        ("warehouse", TUNED, 0.08, 0.25),
    ],
)
def test_errors_stay_small_where_odometry_alone_drifts(tmp_path, drift, world, localizer, rms, most):
    off, _ = errors(tmp_path, world, localizer)
    assert len(off) > 300
    assert np.sqrt((off**2).mean()) < rms
    assert off.max() < most
    assert drift(world) > 2 * np.sqrt((off**2).mean())


def test_other_robots_in_sight_and_noise_of_motors_do_no_harm(tmp_path):
    noise = {**NOISE, "actuation": 0.05, "start_jitter": "2 s"}
    off, record = errors(
        tmp_path, "office", TUNED, noise=noise, scenario={"plugin": "random", "robots": 9}, limits={"execution": "40 s"}
    )
    assert np.sqrt((off**2).mean()) < 0.06
    assert record["metrics"]["execution.robot_contacts"] == 0


def test_recordings_are_the_same_at_any_number_of_workers_and_in_any_process(tmp_path):
    """Two runs in two processes at once, and again in one."""

    def run(name, workers):
        study = {"matrix": {"seed": "0..1"}, "limits": {"execution": "5 s"}, "recording": {"scans": True}}
        base = {"world": "office", "scenario": {"plugin": "random", "robots": 3}, "planner": "prioritized"}
        stack = {"simulator": "planar", "localizer": "amcl", "noise": NOISE, "assigner": "identity", "metrics": []}
        mrpbench_core.run({**base, **stack, **study}, out=tmp_path / name, workers=workers)
        return {file.name: file.read_bytes() for file in (tmp_path / name).rglob("recordings/*.zip")}

    one, two = run("one", 1), run("two", 2)
    assert len(one) == 2
    assert one == two
