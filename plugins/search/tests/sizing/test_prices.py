"""What fleets cost."""

import pytest
from mrpbench_search.saturation.rates import Growth
from mrpbench_search.sizing.fleets import FleetFigures
from mrpbench_search.sizing.prices import read_prices

from mrpbench_core.files.errors import InputError

FILE = """\
currency: EUR
robot: 20000
charger: 2000
service_hours: 10000
robot_hour: 0.5
standstill_hour: 30
kwh: 0.3
"""


def figures(**values):
    fields = {"per_hour": 60, "utilisation": 0.5, "blocked": 0.1, "failed": 0, "runs": 3}
    return FleetFigures(growth=Growth(0, 0, 0), in_time=None, p95=None, **fields | values)


def test_an_hour_is_its_share_of_purchases_upkeep_standstill_and_energy(tmp_path):
    (tmp_path / "prices.yaml").write_text(FILE)
    prices = read_prices(tmp_path / "prices.yaml")
    cost = prices.per_hour(5, 2, figures(energy_wh=400.0))
    assert cost == pytest.approx(5 * 2.0 + 2 * 0.2 + 5 * 0.5 + 5 * 0.1 * 30 + 0.4 * 0.3)
    assert prices.per_hour(5, 0, figures()) == pytest.approx(5 * 2.0 + 5 * 0.5 + 5 * 0.1 * 30)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (FILE + "robots: 3\n", "prices.yaml:8:1: unknown key 'robots'"),
        (FILE.replace("20000", "dear"), "robot must be a number, 0 or more"),
        (FILE.replace("0.3", "-1"), "kwh must be a number, 0 or more"),
        (FILE.replace("service_hours: 10000\n", ""), "service_hours is missing"),
        (FILE.replace("10000", "0"), "service_hours must be more than 0"),
        ("- 3\n", "must be a mapping of prices"),
    ],
)
def test_mistakes_name_the_line(tmp_path, text, message):
    (tmp_path / "prices.yaml").write_text(text)
    with pytest.raises(InputError) as error:
        read_prices(tmp_path / "prices.yaml")
    assert message in str(error.value)
