"""Results folders made of records that tests write by hand, and a reader of pages."""

import pytest
from mrpbench_tests.fixtures.parsed_page import parsed
from mrpbench_tests.fixtures.results_folders import INVOCATION, made, record, results, written

__all__ = ["INVOCATION", "made", "parsed", "record", "results", "written"]


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers):
    """Studies of a module share their worker processes."""
