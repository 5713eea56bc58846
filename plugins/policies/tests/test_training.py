"""The script that trains the policy of this distribution."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from mrpbench_policies.acting import load
from mrpbench_policies.observations import CostToGo

pytest.importorskip("onnx", reason="onnx is not installed")
pytest.importorskip("onnxruntime", reason="the extra `onnx` is not installed")
SCRIPT = runpy.run_path(str(Path(__file__).parents[3] / "scripts" / "train_policy.py"))


def test_training_lowers_the_error_and_writes_a_model_that_says_the_same(tmp_path, capsys):
    generator = np.random.default_rng(0)
    samples = SCRIPT["joined"](SCRIPT["imitated"](generator, 3))
    layers = SCRIPT["new_layers"](generator)
    SCRIPT["train"](layers, samples, generator, 8)
    errors = [float(line.split()[-1]) for line in capsys.readouterr().out.splitlines()]
    assert errors[-1] < 0.9 * errors[0]
    SCRIPT["write"](layers, tmp_path / "small.onnx")
    acting = load(tmp_path / "small.onnx", CostToGo(4), (20, 20))
    rows = samples[0][:6].astype(np.float32)
    acting.begin(len(rows), 0)
    scores = SCRIPT["forward"](layers, rows.reshape(len(rows), -1))[-1]
    np.testing.assert_allclose(acting.act({"observation": rows}), scores, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("turns", range(4))
@pytest.mark.parametrize("mirrored", [False, True])
def test_symmetries_turn_windows_and_actions_alike(turns, mirrored):
    """Of each action, a mark on the cell that it leads to is on that of the new action afterwards."""
    around = [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)]
    windows = np.zeros((5, 1, 3, 3))
    for action, (row, column) in enumerate(around):
        windows[action, 0, 1 + row, 1 + column] = 1
    rows, actions = SCRIPT["turned"](windows, np.arange(5), turns, mirrored)
    for window, action in zip(rows, actions, strict=True):
        row, column = around[action]
        assert window[0, 1 + row, 1 + column] == 1
