"""Run the long measurements of live fleets: one line for each figure, with what was asked of it.

    python benchmarks/live.py
    python benchmarks/live.py --only broker swap

`make live` runs it in an environment of its own with what other parties need: `mosquitto`, `vda5050-sdk`, and the npm
package `vda-5050-lib` on NODE_PATH. It takes about an hour and a half. Fleets of VDA 5050 are tests of
`plugins/live/tests` with larger numbers, `vda5050_vehicles.py` and `vda5050_control.py`; those of Open-RMF are
`rmf_scenarios.py` and `rmf_traffic.py`. The figures of times are those of this machine, which should have nothing else
to do. The return code is 1 if a figure is not what was asked.
"""

import argparse
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import attrs

ROOT = Path(__file__).parents[1]
TESTS = ROOT / "plugins" / "live" / "tests"
ORDERS, MESSAGES, KILLS, SWAPS = 50, 100_000, 20, 100
LAG_MS, AGE_MS, PAUSE_S, SHARE = 50.0, 200.0, 1.3, 0.97
ROBOTS = ("10", "50", "100", "200", "500")


@attrs.frozen
class Figure:
    """A row of the output."""

    name: str
    asked: str
    found: str
    holds: bool

    def __str__(self) -> str:
        return f"{'ok ' if self.holds else 'NOT'}  {self.name}: {self.found} (asked: {self.asked})"


def tested(name: str, asked: str, tests: str) -> Iterator[Figure]:
    """Run tests, as `file.py word`, with the large numbers."""
    large = {"ORDERS": ORDERS, "MESSAGES": MESSAGES, "KILLS": KILLS}
    variables = {f"MRPBENCH_LIVE_{key}": str(value) for key, value in large.items()}
    file, *words = tests.split(maxsplit=1)
    chosen = ["-k", words[0]] if words else []
    command = [
        sys.executable,
        "-m",
        "pytest",
        "--timeout",
        "1800",
        "-p",
        "no:cacheprovider",
        "-rs",
        str(TESTS / file),
    ]
    begin = time.monotonic()
    done = subprocess.run([*command, *chosen], cwd=ROOT, env=os.environ | variables, capture_output=True, text=True)
    lines = done.stdout.strip().splitlines() or [done.stderr.strip()[-300:] or "no output"]
    why = [line for line in lines if line.startswith(("E  ", "SKIPPED"))][:1]
    holds = done.returncode == 0 and "skipped" not in lines[-1] and "passed" in lines[-1]
    took = f"{time.monotonic() - begin:.0f} s"
    yield Figure(name, asked, f"passed in {took}" if holds else " ".join([lines[-1].strip("= "), *why]), holds)


def script(*words: str) -> "subprocess.Popen[str]":
    """Start another benchmark."""
    command = [sys.executable, str(ROOT / "benchmarks" / words[0]), *words[1:]]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


def scenario(*words: str) -> tuple[int, int, float]:
    """Run a scenario; return the pairs of destinations reached, the contacts, and the longest standstill in seconds."""
    said = script("rmf_scenarios.py", *words).communicate()[0]
    found = [re.search(words, said) for words in (r"reached (\d+)", r"contacts (\d+)", r"of both ([\d.]+)")]
    if None in found:
        return 0, -1, -1.0
    swaps, contacts, standstill = (it[1] for it in found if it is not None)
    return int(swaps), int(contacts), float(standstill)


def swaps() -> Iterator[Figure]:
    """The patrol of two robots in a corridor with one lane, with and without an order in which they pass."""
    done, contacts, standstill = scenario("swap", "--seconds", "3600")
    found = f"{done} swaps, {contacts} contacts, both stood for {standstill:.1f} s at most"
    holds = done >= SWAPS and contacts == 0 and 0 <= standstill < 60
    yield Figure("patrol swap by adg, 3,600 s", f"{SWAPS} swaps, no contact, no deadlock", found, holds)
    done, contacts, standstill = scenario("swap", "--seconds", "60", "dispatcher.dispatcher=all_at_once")
    found = f"{done} swaps, {contacts} contacts"
    yield Figure("patrol swap by all_at_once, 60 s", "contacts, or no swap", found, contacts > 0 or done == 0)


def published() -> Iterator[Figure]:
    """The two scenarios that next_gen_prototype publishes."""
    for name, pairs in (("redirect", 2), ("follow", 1)):
        done, contacts, _ = scenario(name)
        found = f"{done} of {pairs} pairs of destinations reached, {contacts} contacts"
        yield Figure(f"scenario {name}", "all reached, no contact", found, done == pairs and contacts == 0)


def vehicles() -> Iterator[Figure]:
    """A thousand vehicles of VDA 5050 that all drive, and a hundred with lidar and `dwb`."""
    for name, words in (("1,000 vehicles", ()), ("100 vehicles with lidar and dwb", ("--vehicles", "100", "--lidar"))):
        said = script("vda5050_vehicles.py", *words).communicate()[0].strip()
        found = [re.search(rf"{words} ([\d.]+)", said) for words in ("age p50 [^,]*, p99", "longest pause", "lag p99")]
        gaps, contacts = re.search(r"(\d+) gaps", said), re.search(r"(\d+) contacts", said)
        if gaps is None or contacts is None or None in found:
            yield Figure(name, "a line", said or "no output", False)
            continue
        age, pause, lag = (float(it[1]) for it in found if it is not None)
        holds = age < AGE_MS and lag < AGE_MS and pause < PAUSE_S and (gaps[1], contacts[1]) == ("0", "0")
        asked = f"a state a second, no gap, age p99 and lag p99 < {AGE_MS:g} ms, no contact"
        yield Figure(name, asked, said.partition(": ")[2], holds)


def shares() -> Iterator[Figure]:
    """Tasks of our fleet control over MQTT, as a share of those in one process, and the same for single plans."""
    for what, words in (("tasks", ()), ("plans", ("--once",))):
        for line in script("vda5050_control.py", *words).communicate()[0].splitlines():
            robots, seed, *figures = line.split()
            if seed == "all":
                alone, over, share = figures
                name = f"{what} of {robots} vehicles by our fleet control, pace 4"
                yield Figure(name, f">= {SHARE:g}", f"{share}: {over} of {alone} an hour", float(share) >= SHARE)


def traffic() -> Iterator[Figure]:
    """The table of fleets of Open-RMF."""
    running = script("rmf_traffic.py", "--robots", *ROBOTS, "--seconds", "60")
    assert running.stdout is not None
    next(running.stdout)
    for line in running.stdout:
        cells = line.split()
        if not cells or not cells[0].isdigit():
            print(line, end="", flush=True)
            continue
        robots, planner, _, plan, _, sent, cpu, other, tasks, standstill, _, contacts, _, lag, behind, _ = cells
        found = (
            f"lag p99 {lag} and {behind} ms, plan p95 {plan} ms, {sent} messages/s, CPU {cpu} and {other}, "
            f"{tasks} tasks/h, {contacts} contacts, standstill {standstill} s"
        )
        holds = max(float(lag), float(behind)) < LAG_MS and contacts == "0"
        yield Figure(f"{robots} robots of Open-RMF, {planner}", f"lag p99 < {LAG_MS:g} ms, no contact", found, holds)


FIGURES: dict[str, Callable[[], Iterator[Figure]]] = {
    "sdk": lambda: tested(
        "vda5050-sdk as fleet control", f"{ORDERS} orders a vehicle, no error", "vda5050/test_master.py"
    ),
    "lib": lambda: tested(
        "vda-5050-lib on both sides", f"{ORDERS} orders a vehicle, no error", "vda5050/test_vda_5050_lib.py"
    ),
    "vehicles": lambda: tested(
        "vehicles of vda5050-sdk under our fleet control", "they swap places", "vda5050/test_foreign_vehicle.py"
    ),
    "hostile": lambda: tested("broken messages", f"{MESSAGES:,} leave the vehicle at work", "vda5050/test_hostile.py"),
    "broker": lambda: tested(
        "broker killed, pace 1 and 5",
        f"{KILLS} times, no contact, no wall",
        "vda5050/test_control.py killed or unheard",
    ),
    "scale": vehicles,
    "share": shares,
    "load": lambda: tested("load of transports", "the knee is found, for ours and another", "vda5050/test_load.py"),
    "scenarios": published,
    "swap": swaps,
    "traffic": traffic,
}


def main() -> int:
    """Measure, and print a line for each figure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=FIGURES, default=list(FIGURES))
    holds = True
    for name in parser.parse_args().only:
        for figure in FIGURES[name]():
            print(figure, flush=True)
            holds &= figure.holds
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
