import numpy as np
import pytest
from mrpbench_policies.acting import load
from mrpbench_policies.observations import PogemaDefault, PogemaPomapf

from mrpbench_core.api import InputError

pytest.importorskip("onnxruntime", reason="the extra `onnx` is not installed")
onnx = pytest.importorskip("onnx", reason="onnx is not installed")
OBSERVATION = PogemaDefault(2)
WEIGHT = np.random.default_rng(0).standard_normal((75, 5)).astype(np.float32)


@pytest.fixture
def loaded(tmp_path):
    """Return a function that loads the bytes of a model."""

    def load_bytes(content, observation=OBSERVATION):
        file = tmp_path / "model.onnx"
        file.write_bytes(content)
        return load(file, observation, (8, 8))

    return load_bytes


def windows(robots, seed=0):
    return {"observation": np.random.default_rng(seed).random((robots, 3, 5, 5)).astype(np.float32)}


@pytest.mark.parametrize("name", ["observation", "obs"])
def test_a_model_scores_all_robots_at_once(loaded, models, name):
    acting = loaded(models.linear(WEIGHT, name=name))
    acting.begin(7, 0)
    rows = windows(7)
    np.testing.assert_allclose(acting.act(rows), rows["observation"].reshape(7, 75) @ WEIGHT, rtol=1e-5)


def test_recurrent_models_remember_from_step_to_step(loaded, models):
    acting = loaded(models.counting())
    acting.begin(2, 0)
    chosen = [acting.act(windows(2)).argmax(axis=1).tolist() for _ in range(3)]
    assert chosen == [[0, 0], [4, 4], [4, 4]]
    assert acting.memory["steps"].tolist() == [[3.0], [3.0]]
    acting.begin(3, 0)
    assert acting.act(windows(3)).argmax(axis=1).tolist() == [0, 0, 0]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda models: b"hello", "is not an ONNX model that onnxruntime runs"),
        (lambda models: models.linear(WEIGHT)[:200], "is not an ONNX model that onnxruntime runs"),
        (lambda models: models.linear(WEIGHT, shape=(4, 3, 5, 5)), "whose first axis has a fixed length"),
        (lambda models: models.linear(np.zeros((147, 5)), shape=("n", 3, 7, 7)), "is [3, 5, 5] for each robot"),
    ],
)
def test_a_model_that_does_not_fit_is_refused_in_one_line(loaded, models, make, message):
    with pytest.raises(InputError) as caught:
        loaded(make(models))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_input_that_the_observation_lacks_is_named(loaded, models):
    kind = onnx.TensorProto.FLOAT
    nodes = [onnx.helper.make_node("Add", ["xy", "speed"], ["scores"])]
    content = models.model(nodes, {"xy": (kind, ["n", 2]), "speed": (kind, ["n", 2])}, {"scores": (kind, ["n", 2])})
    with pytest.raises(InputError, match=r"the input 'speed'; the observation has obstacles, agents, xy, target_xy"):
        loaded(content, PogemaPomapf(2))


def test_nan_and_wrong_shapes_of_scores_are_refused(loaded, models):
    acting = loaded(models.linear(np.full((75, 5), np.nan, np.float32)))
    acting.begin(2, 0)
    with pytest.raises(InputError, match="returned NaN as a score of robot_0"):
        acting.act(windows(2))
    kind = onnx.TensorProto.FLOAT
    nodes = [onnx.helper.make_node("Flatten", ["observation"], ["flat"], axis=1)]
    acting = loaded(models.model(nodes, {"observation": (kind, ["n", 3, 5, 5])}, {"flat": (kind, ["n", 75])}))
    acting.begin(2, 0)
    with pytest.raises(InputError, match=r"returned float32 \[2, 75\], not scores \[2, 5\] or actions \[2\]"):
        acting.act(windows(2))


def test_files_that_are_too_large_or_missing_are_refused(tmp_path):
    large = tmp_path / "large.onnx"
    with large.open("wb") as file:
        file.truncate(500 << 20)
    with pytest.raises(InputError, match="is larger than 256 MiB"):
        load(large, OBSERVATION, (8, 8))
    with pytest.raises(InputError, match="no such file"):
        load(tmp_path / "none.onnx", OBSERVATION, (8, 8))
    (tmp_path / "policy.pt").write_bytes(b"x")
    with pytest.raises(InputError, match="is neither an ONNX model"):
        load(tmp_path / "policy.pt", OBSERVATION, (8, 8))


@pytest.fixture
def apart(tmp_path, models):
    """A model whose weights are in another file."""
    file = tmp_path / "apart.onnx"
    whole = onnx.load_model_from_string(models.linear(WEIGHT))
    onnx.save_model(whole, file, save_as_external_data=True, location="apart.data", size_threshold=0)
    return file


def test_external_data_is_read_from_the_file_of_weights(apart, tmp_path, monkeypatch):
    monkeypatch.chdir("/")
    acting = load(apart, OBSERVATION, (8, 8), weights=tmp_path / "apart.data")
    acting.begin(7, 0)
    rows = windows(7)
    np.testing.assert_allclose(acting.act(rows), rows["observation"].reshape(7, 75) @ WEIGHT, rtol=1e-5)


def test_external_data_that_is_not_named_is_one_line(apart, tmp_path):
    with pytest.raises(InputError, match="its weights are in another file: name that by the option `weights`"):
        load(apart, OBSERVATION, (8, 8))
    with pytest.raises(InputError, match=r"other\.data: no such file"):
        load(apart, OBSERVATION, (8, 8), weights=tmp_path / "other.data")
    (tmp_path / "other.data").write_bytes(b"")
    with pytest.raises(InputError, match=r"does not refer to other\.data"):
        load(apart, OBSERVATION, (8, 8), weights=tmp_path / "other.data")


def test_an_error_of_onnxruntime_says_the_cause_first(loaded, models):
    future = onnx.load_model_from_string(models.linear(WEIGHT))
    future.opset_import[0].version = 999
    with pytest.raises(InputError) as caught:
        loaded(future.SerializeToString())
    message = str(caught.value)
    assert "onnxruntime runs: ONNX Runtime only" in message
    assert "999" in message


@pytest.mark.parametrize("kind", ["UINT8", "INT8", "INT16", "INT32", "FLOAT16", "DOUBLE", "BOOL"])
def test_inputs_have_any_type_of_numbers(loaded, models, kind):
    nodes = [
        onnx.helper.make_node("Cast", ["observation"], ["numbers"], to=onnx.TensorProto.FLOAT),
        onnx.helper.make_node("Flatten", ["numbers"], ["flat"], axis=1),
        onnx.helper.make_node("MatMul", ["flat", "weight"], ["scores"]),
    ]
    inputs = {"observation": (getattr(onnx.TensorProto, kind), ["robots", 3, 5, 5])}
    outputs = {"scores": (onnx.TensorProto.FLOAT, ["robots", 5])}
    acting = loaded(models.model(nodes, inputs, outputs, {"weight": WEIGHT}))
    acting.begin(2, 0)
    rows = {"observation": (windows(2)["observation"] > 0.5).astype(np.float32)}
    np.testing.assert_allclose(acting.act(rows), rows["observation"].reshape(2, 75) @ WEIGHT, rtol=1e-3, atol=1e-4)
