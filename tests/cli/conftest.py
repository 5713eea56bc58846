"""Studies of a module share their worker processes."""

import pytest


@pytest.fixture(scope="module", autouse=True)
def _kept(kept_workers): ...
