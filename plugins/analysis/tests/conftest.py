"""Results folders made of records that tests write by hand."""

import pytest
from mrpbench_tests.fixtures.results_folders import record, results, written

__all__ = ["record", "results", "written"]


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""
