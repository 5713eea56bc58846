"""What a search for a fleet says."""

import pytest
from mrpbench_search.saturation.rates import Growth
from mrpbench_search.sizing.answer import Load, lacking, rows_of, sentence, table
from mrpbench_search.sizing.fleets import FleetFigures, Limits, Verdict
from mrpbench_search.sizing.held_out import HeldOut
from mrpbench_search.sizing.page import write_page
from mrpbench_search.sizing.prices import Prices
from mrpbench_search.sizing.search import Fleets

LOAD = Load(orders="60/h", p95="4min", bound_s=240.0)
BOUNDED, GROWING, UNSURE = Growth(0.0, -0.01, 0.02), Growth(0.3, 0.2, 0.4), Growth(0.06, 0.0, 0.1)
IN_TIME, LATE, EITHER = Limits(0.98, 0.96, 0.99), Limits(0.8, 0.7, 0.9), Limits(0.95, 0.93, 0.97)


def figures(growth=BOUNDED, in_time=IN_TIME, **values):
    fields = {"per_hour": 60, "utilisation": 0.8, "blocked": 0.05, "failed": 0, "runs": 8, "p95": 200.0}
    return FleetFigures(growth=growth, in_time=in_time, **fields | values)


def search(tried, chargers=None):
    fleets = Fleets(study=None, points=(), rate=1.0, bound_s=LOAD.bound_s, requests=None, announce=print)
    fleets.tried, fleets.chargers = tried, chargers or {}
    fleets.installed = max(chargers) if chargers else None
    return fleets


def test_the_smallest_fleet_comes_first_and_then_what_one_fewer_lacks():
    fleets = search({3: figures(GROWING, LATE, utilisation=0.99), 4: figures()})
    assert sentence("hall", fleets, LOAD) == (
        "hall: 4 robots serve 60/h orders within 4min (98.0% of them in time, at least 96.0%); 3 do not (80.0% of them"
        " in time, at most 90.0%): robots run out first"
    )


def test_fleets_that_may_do_come_with_what_is_known_of_them():
    fleets = search({3: figures(BOUNDED, EITHER, runs=64), 2: figures(GROWING, None), 6: figures(BOUNDED, None)})
    assert sentence("hall", fleets, LOAD) == (
        "hall: 6 robots serve 60/h orders within 4min; 3 may do, which 64 runs do not show (95.0% [93.0%, 97.0%] in"
        " time); 5 and 4 may do, which were not tried; 2 do not: aisles run out first"
    )


def test_a_largest_fleet_that_is_not_decided_lacks_nothing():
    fleets = search({3: figures(GROWING, LATE), 6: figures(UNSURE, IN_TIME, utilisation=0.4, runs=4)})
    assert sentence("hall", fleets, LOAD) == (
        "hall: up to 6 robots no fleet is shown to serve 60/h orders within 4min; 6 may do, which 4 runs do not show"
        " (98.0% [96.0%, 99.0%] in time; queues are not shown to be bounded)"
    )


def test_the_fewest_chargers_belong_to_the_fleet():
    tried = {3: figures(GROWING, LATE), 4: figures(chargers_busy=0.4)}
    fleets = search(tried, {4: figures(chargers_busy=0.4), 2: figures(), 1: figures(UNSURE)})
    assert sentence("hall", fleets, LOAD).startswith("hall: 4 robots with 2 chargers (1 may do) serve 60/h")
    names = [row.name for row in rows_of(fleets, None)]
    assert names == ["3 robots, 4 chargers", "4 robots, 4 chargers", "4 robots, 2 chargers", "4 robots, 1 charger"]


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"utilisation": 0.95}, "robots"),
        ({"utilisation": 0.6, "charging": 0.35}, "robots"),
        ({"utilisation": 0.95, "blocked": 0.4}, "aisles"),
        ({"utilisation": 0.6}, "aisles"),
        ({"utilisation": 0.6, "chargers_busy": 0.97}, "chargers"),
        ({"utilisation": 0.95, "blocked": 0.2, "lifts": 0.15}, "lifts"),
        ({"utilisation": 0.95, "blocked": 0.2, "lifts": 0.01}, "aisles"),
    ],
)
def test_what_runs_out_first(values, word):
    assert lacking(figures(**values), 2) == word


def test_one_robot_blocks_no_other_one():
    assert lacking(figures(utilisation=0.98, blocked=0.19), 1) == "robots"


def test_a_fleet_with_an_empty_battery_serves_nothing():
    assert figures().verdict is Verdict.SERVES
    assert figures(empty=0.5).verdict is Verdict.DOES_NOT


def test_a_page_has_the_answer_and_a_chart_for_each_quantity(tmp_path):
    prices = Prices(currency="EUR", robot=10000, service_hours=10000)
    fleets = search({3: figures(GROWING, LATE), 4: figures(energy_wh=50.0, charging=0.2)})
    rows = rows_of(fleets, prices)
    heads, cells = table(rows, "EUR")
    assert heads[-3:] == ["empty", "Wh/h", "EUR/h"]
    assert [row[-1] for row in cells] == ["3.00", "4.00"]
    write_page(tmp_path / "size.html", "hall", "hall: 4 < 5", rows, "EUR", ["held <out>"])
    page = (tmp_path / "size.html").read_text()
    assert "hall: 4 &lt; 5" in page
    assert "held &lt;out&gt;" in page
    assert page.count("<figure>") == 8


def test_a_held_out_run_says_whether_it_serves():
    run = HeldOut(
        robots=4,
        chargers=2,
        hours=10,
        seed=5,
        status="succeeded",
        p95_s=210.0,
        in_time=0.961,
        growth=0.01,
        empty=0.0,
        serves=True,
    )
    assert str(run) == (
        "held out, 10 h on seed 5: 4 robots with 2 chargers serve the orders (succeeded, p95 210 s, 96.1% of the orders"
        " in time, 1.0% pile up)"
    )
