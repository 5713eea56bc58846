"""Messages that no fleet control should send: no vehicle stops for good, and each is one line in the recording."""

import json
import os
import random

from mrpbench_live.vda5050.messages import read

MESSAGES = int(os.environ.get("MRPBENCH_LIVE_MESSAGES", "2000"))
"""Messages that are sent; `make live` sends more."""
VALUES = (
    *(None, True, 0, -1, 2**62, 2**64, 10**400, 1e308, "", "x" * 1000, "\ud800", "\x00", [], {}, [[]], {"a": 1}),
    *(float("nan"), float("inf"), -float("inf"), -0.0, 1e-300, "n1", "o1", "ground", "HARD"),
)
INSTANT = (
    *("startPause", "stopPause", "cancelOrder", "trigger", "initPosition", "startCharging"),
    "clearInstantActions",  # without it, states list all the actions that there ever were, as 3.0 asks
)


def places(message):
    """Every place in a message, as the container and its key."""
    found, todo = [], [message]
    while todo:
        container = todo.pop()
        keys = (
            container if isinstance(container, dict) else range(len(container)) if isinstance(container, list) else ()
        )
        for key in list(keys):
            found.append((container, key))
            todo.append(container[key])
    return found


def mutated(rng, message):
    """A message with one to four changes, as bytes."""
    message = json.loads(json.dumps(message))
    for _ in range(rng.randint(1, 4)):
        spots = places(message)
        if not spots:
            break
        container, key = rng.choice(spots)
        if rng.random() < 0.25:
            del container[key]
        elif rng.random() < 0.5:
            container[key] = rng.choice(VALUES)
        else:
            other, name = rng.choice(spots)
            container[key] = json.loads(json.dumps(other[name]))
    payload = bytearray(json.dumps(message).encode())
    if rng.random() < 0.2:
        for _ in range(rng.randint(1, 5)):
            payload[rng.randrange(len(payload))] = rng.randrange(256)
    return bytes(payload[: rng.randrange(len(payload))] if rng.random() < 0.05 else payload)


def test_mutated_messages_stop_no_vehicle(bench):
    rng = random.Random(0)
    bench.take(bench.order([0, 1, 2, 3], base=3, s2={"actions": [bench.action("pick")]}))
    before = len(bench.events)
    for number in range(MESSAGES):
        instant = rng.random() < 0.3
        if instant:
            kind = rng.choice(INSTANT)
            message = {**bench._header(), "actions": [bench.action(kind, f"i{number}", "NONE", x=1.0, y=0.0)]}
        else:
            actions = [bench.action(rng.choice(["pick", "drop", "waitForTrigger"]), f"a{number}")]
            first = bench.vehicle.last_sequence
            way = [bench.x, bench.x + 1, bench.x]
            parts = {f"s{first + 2}": {"actions": actions}}
            name, update = rng.choice([("o1", number), (f"o{number}", 0)])
            message = bench.order(way, base=2, update=update, first=first if update else 0, id=name, **parts)
        taken, fault = read(mutated(rng, message))
        topic = "instantActions" if instant else "order"
        fault = fault or bench._faults[topic](taken)
        (bench.instant.take if instant else bench.vehicle.take_order)(taken, fault)
        bench.step()
        if bench.may_drive and bench.x < 8:
            bench.paths.released[0] = bench.paths.passed[0] + 1
            bench.paths.passed[0] += 1
    assert len(bench.events) > before
    assert all(isinstance(detail, str) and len(kind) < 20 for kind, detail in bench.events)
    bench.act(bench.action("stopPause", "end-1", "NONE"), bench.action("stopCharging", "end-2", "NONE"))
    bench.act(bench.action("cancelOrder", "end-3", "NONE"))
    bench.paths.passed[0] = bench.paths.length[0]
    bench.step()
    state = bench.take(bench.order([bench.vehicle.here.pose[0], 0], base=2, id="the last one"))
    assert state["orderId"] == "the last one"
