"""`mrpbench size STUDY --orders RATE [key=value…]`: find the smallest fleet that serves a stream of orders."""

import argparse
import math
import re
from pathlib import Path

from mrpbench_core.cli.output.table import print_json, print_table
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.text import counted
from mrpbench_core.model.common.units import quantity
from mrpbench_search.asking.arguments import add_search, searching, study_of
from mrpbench_search.asking.budget import Budget
from mrpbench_search.asking.configurations import only_configuration
from mrpbench_search.asking.requests import read_whole_study, seeds_of
from mrpbench_search.saturation.rates import TOLERANCE
from mrpbench_search.sizing.answer import Load, Row, document, rows_of, sentence, table
from mrpbench_search.sizing.fleets import LOOKS, SHARE, smallest
from mrpbench_search.sizing.held_out import HeldOut, drive_held_out
from mrpbench_search.sizing.page import write_page
from mrpbench_search.sizing.prices import Prices, read_prices
from mrpbench_search.sizing.search import Fleets
from mrpbench_search.sizing.study import check_study

_RATE = re.compile(r"([\d.]+) ?(?:/|an? |per )? ?(h|hour|min|minute)")
MINUTES = {"h": 60, "hour": 60, "min": 1, "minute": 1}


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        f"A fleet serves the orders if fewer than {TOLERANCE:.0%} of them pile up and {SHARE:.0%} of them are done"
        " within --p95, each with 95 % confidence over seeds, and no battery runs empty. Fleets of which nothing is"
        f" shown are repeated with twice as many seeds, up to {2 ** (LOOKS - 1)} times those of the study. Exit code: 0"
        " the smallest fleet is known, 1 it is not, 2 the configuration is wrong, 130 interrupted (the same command"
        " continues)."
    )
    add_search(parser, "results/NAME-size")
    parser.add_argument("--orders", required=True, metavar="RATE", help="orders that arrive, e.g. `300/h` or `5/min`")
    parser.add_argument("--p95", metavar="TIME", help="bound of the 95th percentile of service times, e.g. `4min`")
    parser.add_argument("--prices", type=Path, metavar="FILE", help="prices, for what each fleet costs")
    parser.add_argument(
        "--held-out", metavar="TIME", help="then drive the answer and one robot fewer so long on the next seed"
    )


def run(arguments: argparse.Namespace) -> int:
    """Search the fleet and print it."""
    file, overrides = study_of(arguments)
    rate, bound_s = _rate(arguments.orders), _time(arguments.p95, "--p95")
    held_out_s = _time(arguments.held_out, "--held-out")
    prices = None if arguments.prices is None else read_prices(arguments.prices)
    load = Load(orders=arguments.orders, p95=arguments.p95, bound_s=bound_s)
    with slots_of_this_process():
        study = read_whole_study(file, overrides)
        points = only_configuration(study)
        check_study(points)
        if len(seeds_of(points)) < 2:
            raise InputError("seed: a fleet is judged by two seeds or more", hint="e.g. seed=0..4")
        out = Path(arguments.out or f"results/{study.name}-size")
        with searching(arguments, out, overrides) as requests:
            fleets = Fleets(study=study, points=points, rate=rate, bound_s=bound_s, requests=requests, announce=_say)
            end = fleets.run(points[0].canonical["scenario"]["robots"])
            held_out: list[HeldOut] = []
            if math.isfinite(held_out_s):
                requests.budget = Budget()
                held_out = drive_held_out(fleets, held_out_s)
    said, rows = sentence(study.name, fleets, load), rows_of(fleets, prices)
    low, high = smallest(fleets.verdicts)
    notes = [f"{each}" for each in held_out]
    if rows:
        write_page(out / "size.html", study.name, said, rows, _currency(prices), notes)
    if arguments.json:
        print_json(
            {
                "answer": said,
                "interval": [low, high],
                "orders_per_min": rate,
                "p95_s": bound_s if math.isfinite(bound_s) else None,
                "fleets": document(rows),
                "held_out": [each.document() for each in held_out],
                "runs": len(requests.asked),
                "ended": end,
                "out": str(out),
            }
        )
    else:
        _print(said, rows, _currency(prices), notes)
        print(f"{counted(len(requests.asked), 'run')} in {out}" + (f"; the search ended before: {end}" if end else ""))
    return int(low != high)


def _say(text: str) -> None:
    print(text, flush=True)


def _currency(prices: Prices | None) -> str:
    return "" if prices is None else prices.currency


def _rate(text: str) -> float:
    found = _RATE.fullmatch(text.strip())
    try:
        rate = float(found[1]) / MINUTES[found[2]] if found else 0.0
    except ValueError:
        rate = 0.0
    if not rate > 0:
        raise InputError(f"--orders {text}: expected a rate", hint="e.g. `300/h` or `5/min`")
    return rate


def _time(text: str | None, option: str) -> float:
    """Seconds; infinite without a text."""
    if text is None:
        return math.inf
    try:
        seconds = quantity(text, "s")
    except ValueError:
        seconds = 0.0
    if not seconds > 0:
        raise InputError(f"{option} {text}: expected a time", hint="e.g. `4min`")
    return float(seconds)


def _print(said: str, rows: list[Row], currency: str, notes: list[str]) -> None:
    print(f"\n{said}")
    for note in notes:
        print(note)
    if rows:
        print_table(*table(rows, currency))
