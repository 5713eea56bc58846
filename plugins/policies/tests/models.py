"""ONNX models made for tests."""

import numpy as np
from onnx import TensorProto, helper, numpy_helper


def model(nodes, inputs, outputs, weights=()):
    """Return the bytes of a model; inputs and outputs are {name: (element type, shape)}."""
    infos = [
        [helper.make_tensor_value_info(name, kind, shape) for name, (kind, shape) in values.items()]
        for values in (inputs, outputs)
    ]
    arrays = [numpy_helper.from_array(np.asarray(array), name) for name, array in dict(weights).items()]
    graph = helper.make_graph(list(nodes), "test", *infos, arrays)
    made = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    return made.SerializeToString()


def linear(weight, shape=("robots", 3, 5, 5), name="observation", bias=None):
    """Return a model that multiplies the flattened observation by `weight` f4[k,5]."""
    weights = {"weight": np.asarray(weight, np.float32), "bias": np.zeros(5, np.float32) if bias is None else bias}
    nodes = [
        helper.make_node("Flatten", [name], ["flat"], axis=1),
        helper.make_node("Gemm", ["flat", "weight", "bias"], ["scores"]),
    ]
    return model(
        nodes, {name: (TensorProto.FLOAT, list(shape))}, {"scores": (TensorProto.FLOAT, ["robots", 5])}, weights
    )


def counting():
    """Return a recurrent model that ignores the observation: it stays in the first step, then goes right."""
    weights = {
        "one": np.ones((1, 1), np.float32),
        "none": np.zeros((75, 5), np.float32),
        "right": np.array([[0, 0, 0, 0, 1]], np.float32),
        "stay": np.array([0.5, 0, 0, 0, 0], np.float32),
    }
    nodes = [
        helper.make_node("Add", ["steps", "one"], ["next_steps"]),
        helper.make_node("Flatten", ["observation"], ["flat"], axis=1),
        helper.make_node("MatMul", ["flat", "none"], ["nothing"]),
        helper.make_node("Gemm", ["steps", "right", "stay"], ["wish"]),
        helper.make_node("Add", ["nothing", "wish"], ["scores"]),
    ]
    return model(
        nodes,
        {"observation": (TensorProto.FLOAT, ["robots", 3, 5, 5]), "steps": (TensorProto.FLOAT, ["robots", 1])},
        {"scores": (TensorProto.FLOAT, ["robots", 5]), "next_steps": (TensorProto.FLOAT, ["robots", 1])},
        weights,
    )
