"""Runs configurations that are drawn from the JSON Schema: each is refused in a line, or ends in a status that is no
defect of a component.

    python tests/engine/soak_configurations.py COUNT SEED [--extreme SHARE]

A configuration chooses plugins of all kinds and some of their options at random. A share of all numbers is extreme:
zero, negative, tiny, or as large as an option takes. Prints each configuration that is not as it should be; then the
exit code is 1.
"""

import argparse
import json
import random
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Any

from mrpbench_core import run
from mrpbench_core.config.schema import schema
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError, InputErrors

SCHEMA = schema()
WORLDS = {"office", "household", "bottlenecks", "encounters", "generated_rooms"}
WORLDS |= {"generated_random", "generated_warehouse"}
"""The small ones."""
LEFT_OUT = {
    "barn",
    "dask",
    "external",
    "ros2",
    "named",
    "file",
    "trace",
    "lorr",
    "scripted",
    "dynabarn",
    "league",
    "movingai",
    "charging",
    "live",
    "pogema",
    "policy",
    "rmf",
    "vda5050",
}
"""Plugins that need files, programs, outside parties or options that cannot be drawn."""
NEEDED: dict[str, dict[str, Any]] = {
    "random": {"robots": 3},
    "poisson": {"rate": 3},
    "pickup_delivery": {"rate": 3, "pickups": ["*"], "dropoffs": ["*"]},
    "rotation_shim": {"primary_controller": "pure_pursuit"},
    "global_planner": {"primary_controller": "pure_pursuit"},
    "rolling_horizon": {"planner": "prioritized"},
}
"""Options without a default, by plugin."""
CHANCES = {"world": 1.0, "scenario": 1.0, "planner": 1.0, "roadmap": 0.4, "controller": 0.4, "dispatcher": 0.4}
"""Of keys; 0.15 of the others."""
LIMITS = {"planning": "5 s", "execution": "30 s", "wall": "60 s", "memory": "3 GiB"}
DEFECTS = {"crashed", "contract_broken", "promise_broken", "out_of_memory"}


class Drawing:
    """Draws configurations.

    Args:
        seed: of the configuration.
        extreme: share of extreme numbers.
    """

    def __init__(self, seed: int, extreme: float) -> None:
        self._rng = random.Random(seed)
        self._extreme = extreme

    def configuration(self) -> dict[str, Any]:
        """Return one as plain data."""
        keys = SCHEMA["properties"].items()
        drawn = {key: self._value(kind) for key, kind in keys if self._rng.random() < CHANCES.get(key, 0.15)}
        drawn |= {"name": "drawn", "seed": self._rng.randrange(1000)}
        drawn.pop("matrix", None)
        if drawn["world"]["plugin"].startswith("generated"):  # these have no lanes
            drawn["roadmap"] = "grid"
        limits = drawn.get("limits") or {}
        return {**drawn, "limits": {**limits, **LIMITS}}

    def _value(self, kind: dict[str, Any]) -> Any:
        if "$ref" in kind:
            return self._component(kind["$ref"].rpartition("/")[2])
        if "enum" in kind:
            return self._rng.choice(kind["enum"])
        options = kind.get("anyOf", [])
        if any("pattern" in option for option in options) and "examples" in kind:  # a quantity
            return self._number(kind.get("default"))
        if options:
            named = [option for option in options if "$ref" in option]
            return self._value(self._rng.choice(named or [option for option in options if _can_be_drawn(option)]))
        if kind.get("type") == "object":
            return self._options(kind.get("properties", {}))
        if kind.get("type") == "array":
            entries = kind.get("prefixItems") or [kind.get("items", {})] * self._rng.choice((1, 1, 2))
            return [self._value(entry) for entry in entries]
        if kind.get("type") in ("number", "integer"):
            number = self._number(kind.get("default"))
            return int(number) if kind["type"] == "integer" else number
        return self._rng.random() < 0.5

    def _number(self, default: Any) -> float:
        if self._rng.random() < self._extreme:
            return self._rng.choice((0, -1, 1e-9, 1e3, 1e5, 1e6, 1e9, 2**31, 2**62))
        usual = default if isinstance(default, int | float) else 1
        return usual * self._rng.choice((0.5, 1, 1, 1, 1.1, 2))

    def _options(self, properties: dict[str, Any], chance: float = 0.15) -> dict[str, Any]:
        drawn = {name: kind for name, kind in properties.items() if self._rng.random() < chance and _can_be_drawn(kind)}
        return {name: self._value(kind) for name, kind in drawn.items()}

    def _component(self, group: str) -> Any:
        blocks = [block["properties"] for block in SCHEMA["$defs"][group]["oneOf"] if "title" in block]
        names = [block["plugin"]["const"] for block in blocks]
        usable = [name for name in names if name not in LEFT_OUT and (group != "mrpbench.worlds" or name in WORLDS)]
        name = self._rng.choice(usable or names)
        options = {key: kind for key, kind in blocks[names.index(name)].items() if key != "plugin"}
        chance = self._rng.choice((0, 0, 0.05, 0.2))
        return {"plugin": name, **NEEDED.get(name, {}), **self._options(options, chance)}


def _can_be_drawn(kind: dict[str, Any]) -> bool:
    """Tell whether any value of a kind will do: free text is the name of something, and `none` is another matter."""
    options = kind.get("anyOf")
    if options and "examples" not in kind:
        return any(map(_can_be_drawn, options))
    return kind.get("type") != "string" and "none" not in kind.get("enum", ())


def fault_of(configuration: dict[str, Any], ends: Counter[str]) -> str | None:
    """Return what is not as it should be, and count how it ends."""
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        try:
            records = list(run(configuration, out=Path(folder)))
        except (InputError, InputErrors) as refused:
            ends["refused"] += 1
            lines = [refused] if isinstance(refused, InputError) else refused.errors
            return next((f"refused: {line}" for line in map(str, lines) if "\n" in line or "Error" in line), None)
        except Exception as error:  # noqa: BLE001 - which is what this looks for
            ends["raised"] += 1
            return f"{type(error).__name__}: {error}"
    for record in records:
        ends[record["status"]] += 1
        if record["status"] in DEFECTS:
            return f"{record['status']}: {record['error']['message']}"
    took = time.monotonic() - began
    return f"took {took:.0f} s" if took > 120 else None


def main() -> int:
    """Run the configurations."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int)
    parser.add_argument("seed", type=int)
    parser.add_argument("--extreme", type=float, default=0.05, help="share of extreme numbers (default: %(default)s)")
    given = parser.parse_args()
    ends: Counter[str] = Counter()
    faults = 0
    with slots_of_this_process():
        for seed in range(given.seed, given.seed + given.count):
            configuration = Drawing(seed, given.extreme).configuration()
            if (fault := fault_of(configuration, ends)) is not None:
                faults += 1
                print(f"{seed}: {fault}\n  {json.dumps(configuration)}", flush=True)
    print(f"{given.count} configurations, {faults} faults; {dict(ends)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
