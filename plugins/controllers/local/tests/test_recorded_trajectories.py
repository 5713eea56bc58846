"""What controllers weigh, in recordings of whole executions."""

import numpy as np
import pytest

import mrpbench_core
from mrpbench_core.store.recording import Recording

pytestmark = pytest.mark.usefixtures("kept_workers")
CONTROLLERS = {
    "dwb": {"plugin": "dwb"},
    "mppi": {"plugin": "mppi", "batch_size": 100},
    "rotation_shim": {"plugin": "rotation_shim", "primary_controller": "rpp"},
}


@pytest.mark.parametrize("controller", CONTROLLERS.values(), ids=CONTROLLERS)
def test_recording_trajectories_changes_nothing_else_at_any_number_of_workers(tmp_path, controller):
    pytest.importorskip("mrpbench_planners_mapf")
    study = {
        "world": "office",
        "scenario": {"plugin": "random", "robots": 3},
        "planner": "prioritized",
        "controller": controller,
        "simulator": "planar",
        "limits": {"execution": 4},
        "metrics": [],
        "seed": 1,
    }
    asked = {"trajectories": {"robots": [0, 2], "every": 2}}
    runs = {
        "without": mrpbench_core.run(study, out=tmp_path / "without"),
        "one": mrpbench_core.run(study | {"recording": asked}, out=tmp_path / "one"),
        "two": mrpbench_core.run(
            study | {"recording": asked, "matrix": {"seed": [1, 2]}}, out=tmp_path / "two", workers=2
        ),
    }
    first = {name: next(row["run_id"] for row in rows if row["seed"] == 1) for name, rows in runs.items()}
    files = {name: tmp_path / name / "recordings" / f"{run_id}.zip" for name, run_id in first.items()}
    assert files["one"].name == files["two"].name
    assert files["one"].read_bytes() == files["two"].read_bytes()
    plain, recorded = (Recording(files[name]) for name in ("without", "one"))
    new = {name for name in recorded.channels if name.startswith(("trajectory_", "critic_"))}
    assert not new & set(plain.channels)
    assert set(recorded.channels) == set(plain.channels) | new
    for name in plain.channels:
        np.testing.assert_array_equal(plain.channel(name), recorded.channel(name), name)
    assert set(recorded.channel("trajectory_robot").tolist()) == {0, 2}
    assert len(set(recorded.channel("trajectory_time").tolist())) > 10
    plain.close()
    recorded.close()
