import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_exporters_rosbag2.blocks import Blocks

tenths = st.lists(st.integers(0, 30).map(lambda value: value / 10), max_size=25).map(sorted)


def chunk(times, events):
    return {
        "time": np.array(times, float),
        "truth": np.arange(len(times) * 3.0).reshape(-1, 1, 3),
        "event_time": np.array(events, float),
        "event_kind": np.array([f"kind {index}" for index in range(len(events))], "U"),
        "event_robot": np.zeros(len(events), "i4"),
        "event_detail": np.array([""] * len(events), "U"),
    }


def split(whole, edges):
    for low, high in zip([-np.inf, *edges], [*edges, np.inf], strict=True):
        yield {
            name: values[
                (whole[axis := "event_time" if name.startswith("event") else "time"] >= low) & (whole[axis] < high)
            ]
            for name, values in whole.items()
        }


@given(times=tenths.map(lambda values: sorted(set(values))), events=tenths, edges=tenths, instants=st.integers(1, 5))
def test_blocks_hold_everything_once_in_order_of_time(times, events, edges, instants):
    whole = chunk(times, events)
    blocks = Blocks(instants)
    found = [block for piece in split(whole, edges) for block in blocks.push(piece)] + list(blocks.finish())
    for name, values in whole.items():
        parts = [block[name] for block in found if name in block]
        assert np.array_equal(np.concatenate(parts) if parts else values[:0], values)
    latest = -np.inf
    for block in found:
        stamps = np.concatenate([block[axis] for axis in ("time", "event_time") if axis in block])
        assert stamps.min() > latest  # no instant is shared between blocks
        latest = stamps.max()
        assert len(block.get("time", ())) <= instants


def test_only_the_newest_instant_is_held_back():
    blocks = Blocks(100)
    whole = chunk(np.arange(50) / 10, [0.0, 4.9])
    (block,) = blocks.push(whole)
    assert block["time"][-1] == 4.8
    assert block["event_time"].tolist() == [0.0]
    (rest,) = blocks.finish()
    assert (rest["time"].tolist(), rest["event_time"].tolist()) == ([4.9], [4.9])
    assert list(blocks.finish()) == []
