"""Trains the policy that this distribution ships, and writes it as an ONNX model: `make policy`.

A network with two hidden layers imitates LaCAM* (Okumura, AAAI 2023, IJCAI 2023) on random maps and mazes of the sizes
of POGEMA's benchmark. In further rounds it drives the robots itself, and LaCAM* says what it should have done (DAgger;
Ross, Gordon and Bagnell, AISTATS 2011). Needs `mrpbench-standard` and `onnx`; everything else is NumPy.
"""

import argparse
import math
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import attrs
import numpy as np
import onnx
from mrpbench_planners_mapf.lacam import Lacam
from mrpbench_policies.board import Board, board_of
from mrpbench_policies.fleet_state import FleetState
from mrpbench_policies.maps import MOVES
from mrpbench_policies.observations import CostToGo
from mrpbench_policies.shields import pibt
from onnx import TensorProto, helper, numpy_helper

from mrpbench_core.api import Budget, Problem, Roadmap
from mrpbench_core.model.planning.problem import features_of
from mrpbench_core.testing.drawing import grid

RADIUS = 4
LAYERS = (4 * (2 * RADIUS + 1) ** 2, 256, 128, 5)
WEIGHTS = Path(__file__).parents[1] / "plugins" / "policies" / "mrpbench_policies" / "weights" / "imitation.onnx"
Layers = list[tuple[np.ndarray, np.ndarray]]
Samples = tuple[np.ndarray, np.ndarray]
"""Windows u1 or f2[k,4,side,side], and actions i1[k]."""


def random_map(generator: np.random.Generator) -> np.ndarray:
    """Return blocked cells bool[rows,columns]: of 17 to 21 rows and columns, 10 to 30 % at random."""
    shape = generator.integers(17, 22, 2)
    blocked: np.ndarray = generator.random(shape) < generator.uniform(0.1, 0.3)
    return blocked


def maze(generator: np.random.Generator) -> np.ndarray:
    """Return a maze by depth-first search, with some of its walls removed."""
    rows, columns = generator.integers(8, 11, 2)
    blocked = np.ones((2 * rows + 1, 2 * columns + 1), bool)
    stack = [(0, 0)]
    blocked[1, 1] = False
    while stack:
        row, column = stack[-1]
        around = [(row + up, column + right) for up, right in MOVES[1:].tolist()]
        around = [(r, c) for r, c in around if 0 <= r < rows and 0 <= c < columns and blocked[2 * r + 1, 2 * c + 1]]
        if not around:
            stack.pop()
            continue
        r, c = around[generator.integers(len(around))]
        blocked[2 * r + 1, 2 * c + 1] = blocked[row + r + 1, column + c + 1] = False
        stack.append((r, c))
    inner = blocked[1:-1, 1:-1]
    inner &= generator.random(inner.shape) > generator.uniform(0.0, 0.4)
    return inner


def instance(generator: np.random.Generator) -> tuple[Roadmap, np.ndarray, np.ndarray]:
    """Return a roadmap, and starts and goals i8[n] in one component of it."""
    while True:
        blocked = (maze if generator.random() < 0.5 else random_map)(generator)
        closed = zip(*np.nonzero(blocked[::-1]), strict=True)
        roadmap = grid(*blocked.shape, closed)
        board = board_of(roadmap, RADIUS)
        assert isinstance(board, Board)
        steps = board.maps.distances(int(board.place[generator.integers(len(board.place))]))
        inside = np.flatnonzero(steps[board.place] < 1 << 20)
        robots = int(generator.choice([8, 16, 24, 32, 48, 64]))
        if len(inside) >= 2 * robots:
            return roadmap, generator.permutation(inside)[:robots], generator.permutation(inside)[:robots]


def expert(roadmap: Roadmap, start: np.ndarray, goal: np.ndarray, iterations: int) -> np.ndarray | None:
    """Return the vertices i8[T+1,n] of a plan of LaCAM*, None if it finds none within a second."""
    problem = Problem(
        roadmap=roadmap,
        profile=np.zeros(len(start), "i4"),
        radius=np.full(len(start), 0.1),
        start=start.astype("i4"),
        ready=np.zeros(len(start), "i8"),
        goals=tuple(((int(vertex),),) for vertex in goal),
    )
    problem = attrs.evolve(problem, features=features_of(problem))
    result = Lacam().plan(problem, Budget(wall_s=1.0, memory_bytes=1 << 30, iterations=iterations))
    if result.plan is None:
        return None
    length = max((int(path.leave[-1]) for path in result.plan.paths if len(path)), default=0)
    trace = np.repeat(start[None].astype(np.int64), length + 1, axis=0)
    for robot, path in enumerate(result.plan.paths):
        for edge, leave in zip(path.edge.tolist(), path.leave.tolist(), strict=True):
            if edge >= 0:
                trace[leave:, robot] = roadmap.edges[edge, 1]
    return trace


def actions_of(board: Board, before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Return the actions i8[n] that lead from vertices to vertices."""
    step = board.place[after] - board.place[before]
    return (step[:, None] == board.maps.offset).argmax(axis=1)


def imitated(generator: np.random.Generator, count: int) -> Iterator[Samples]:
    """Yield what robots perceive along plans, and what they do."""
    observation = CostToGo(RADIUS)
    for _ in range(count):
        roadmap, start, goal = instance(generator)
        trace = expert(roadmap, start, goal, 300)
        if trace is None:
            continue
        board = board_of(roadmap, RADIUS)
        assert isinstance(board, Board)
        state = FleetState.at(board.maps, board.place[start][None], board.place[goal][None])
        for before, after in pairwise(trace):
            rows = observation.observe(state)["observation"]
            yield chosen(generator, rows, actions_of(board, before, after), state.on_goal[0])
            state.move(board.place[after][None])


def corrected(generator: np.random.Generator, layers: Layers, count: int) -> Iterator[Samples]:
    """Yield what robots perceive where the network leads them, and what LaCAM* does there."""
    observation = CostToGo(RADIUS)
    for _ in range(count):
        roadmap, start, goal = instance(generator)
        board = board_of(roadmap, RADIUS)
        assert isinstance(board, Board)
        state = FleetState.at(board.maps, board.place[start][None], board.place[goal][None])
        priority = np.zeros(len(start), np.int64)
        for step in range(64):
            rows = observation.observe(state)["observation"]
            scores = forward(layers, rows.reshape(len(rows), -1))[-1]
            if step % 4 == int(generator.integers(4)):
                here = board.vertex[state.place[0]].astype(np.int64)
                trace = expert(roadmap, here, goal, 50)
                if trace is not None and len(trace) > 1:
                    yield chosen(generator, rows, actions_of(board, trace[0], trace[1]), state.on_goal[0])
            state.move(pibt(state, scores.argmax(axis=1), scores, priority))
            priority = np.where(state.on_goal[0], 0, priority + 1)
            if state.on_goal.all():
                break


def chosen(generator: np.random.Generator, rows: np.ndarray, actions: np.ndarray, on_goal: np.ndarray) -> Samples:
    """Return a part of the robots, fewer of those that rest at their goals."""
    taken = generator.random(len(rows)) < np.where(on_goal & (actions == 0), 0.1, 0.5)
    return rows[taken].astype(np.float16), actions[taken].astype(np.int8)


def new_layers(generator: np.random.Generator) -> Layers:
    """Return a network with random weights (He et al., ICCV 2015)."""
    return [
        (
            (generator.standard_normal((width, after)) * math.sqrt(2 / width)).astype(np.float32),
            np.zeros(after, np.float32),
        )
        for width, after in pairwise(LAYERS)
    ]


def forward(layers: Layers, rows: np.ndarray) -> list[np.ndarray]:
    """Return the values of all layers, the last of which are the scores f4[k,5]."""
    values = [rows]
    for number, (weight, bias) in enumerate(layers):
        value = values[-1] @ weight + bias
        values.append(np.maximum(value, 0) if number + 1 < len(layers) else value)
    return values


SYMMETRIES = [(turns, mirrored) for turns in range(4) for mirrored in (False, True)]


def turned(rows: np.ndarray, actions: np.ndarray, turns: int, mirrored: bool) -> Samples:
    """Return samples as they are on a map that is turned and mirrored."""
    rows = np.rot90(rows, turns, axes=(2, 3))
    moves = MOVES.copy()
    for _ in range(turns):
        moves = np.column_stack([-moves[:, 1], moves[:, 0]])  # counter-clockwise: right becomes up
    if mirrored:
        rows, moves = rows[..., ::-1], moves * (1, -1)
    number = (moves[:, None] == MOVES[None]).all(axis=2).argmax(axis=1)
    return rows, number[actions]


def train(layers: Layers, samples: Samples, generator: np.random.Generator, epochs: int) -> None:
    """Improve a network in place by Adam (Kingma and Ba, ICLR 2015) on the cross entropy, with symmetries."""
    rows, actions = samples
    first = [np.zeros_like(array) for pair in layers for array in pair]
    second = [np.zeros_like(array) for pair in layers for array in pair]
    batch, step = min(1024, len(rows)), 0
    total = epochs * (len(rows) // batch)
    for epoch in range(epochs):
        order, loss = generator.permutation(len(rows)), 0.0
        for begin in range(0, len(rows) - batch + 1, batch):
            index = order[begin : begin + batch]
            some, wanted = turned(rows[index], actions[index], *SYMMETRIES[generator.integers(8)])
            values = forward(layers, some.reshape(batch, -1).astype(np.float32))
            share = np.exp(values[-1] - values[-1].max(axis=1, keepdims=True))
            share /= share.sum(axis=1, keepdims=True)
            loss -= float(np.log(share[np.arange(batch), wanted] + 1e-9).mean())
            slope = share
            slope[np.arange(batch), wanted] -= 1
            slope /= batch
            gradients: list[np.ndarray] = []
            for number in range(len(layers) - 1, -1, -1):
                gradients[:0] = [values[number].T @ slope, slope.sum(axis=0)]
                slope = (slope @ layers[number][0].T) * (values[number] > 0)
            step += 1
            rate = 2e-3 * 0.5 * (1 + math.cos(math.pi * step / total))
            parameters = [array for pair in layers for array in pair]
            for array, gradient, mean, square in zip(parameters, gradients, first, second, strict=True):
                mean += 0.1 * (gradient - mean)
                square += 0.001 * (gradient * gradient - square)
                scale = rate * math.sqrt(1 - 0.999**step) / (1 - 0.9**step)
                array -= (scale * mean / (np.sqrt(square) + 1e-8)).astype(np.float32)
        print(f"epoch {epoch + 1}/{epochs}: cross entropy {loss / (len(rows) // batch):.4f}", flush=True)


def write(layers: Layers, file: Path) -> None:
    """Write a network as an ONNX model from windows f4[robots,4,9,9] to scores f4[robots,5]."""
    side = 2 * RADIUS + 1
    weights, nodes = [], [helper.make_node("Flatten", ["observation"], ["layer_0"], axis=1)]
    for number, (weight, bias) in enumerate(layers):
        last = number + 1 == len(layers)
        weights += [numpy_helper.from_array(weight, f"w{number}"), numpy_helper.from_array(bias, f"b{number}")]
        out = "scores" if last else f"sum_{number + 1}"
        nodes.append(helper.make_node("Gemm", [f"layer_{number}", f"w{number}", f"b{number}"], [out]))
        if not last:
            nodes.append(helper.make_node("Relu", [out], [f"layer_{number + 1}"]))
    graph = helper.make_graph(
        nodes,
        "imitation",
        [helper.make_tensor_value_info("observation", TensorProto.FLOAT, ["robots", 4, side, side])],
        [helper.make_tensor_value_info("scores", TensorProto.FLOAT, ["robots", 5])],
        weights,
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8)
    onnx.checker.check_model(model)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(model.SerializeToString())


def main() -> None:
    """Train."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--instances", type=int, default=600, help="problems that LaCAM* solves")
    parser.add_argument("--corrections", type=int, default=150, help="problems in each round of corrections")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--epochs", type=int, default=12)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=WEIGHTS)
    wanted = parser.parse_args()
    generator = np.random.default_rng(wanted.seed)
    layers = new_layers(generator)
    began = time.monotonic()
    samples = joined(imitated(generator, wanted.instances))
    for number in range(wanted.rounds + 1):
        print(f"{time.monotonic() - began:.0f} s, round {number}: {len(samples[0])} samples", flush=True)
        train(layers, samples, generator, wanted.epochs)
        if number < wanted.rounds:
            samples = joined([samples, *corrected(generator, layers, wanted.corrections)])
    write(layers, wanted.out)
    print(f"{wanted.out}: {wanted.out.stat().st_size} bytes after {time.monotonic() - began:.0f} s")


def joined(parts: "Iterator[Samples] | list[Samples]") -> Samples:
    """Return all samples."""
    rows, actions = zip(*parts, strict=True)
    return np.concatenate(rows), np.concatenate(actions)


if __name__ == "__main__":
    main()
