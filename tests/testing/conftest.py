import pytest

from mrpbench_core.builtin.scenarios.random import Random
from mrpbench_core.files.scenario import write_scenario
from mrpbench_core.testing.fixtures.office import office, office_roadmap
from mrpbench_core.testing.fixtures.room import fleet


@pytest.fixture
def frozen_scenario():
    """Return a function that writes a scenario of two robots in the office to a file."""

    def write(path):
        write_scenario(path, Random(robots=2).draw(office(), office_roadmap(), fleet(2), 0))

    return write
