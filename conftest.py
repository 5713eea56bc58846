"""Fixtures that every test folder shares."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from mrpbench_core.engine.processes.slots import slots_of_this_process

# The same examples in every run, so that a change is judged by what it changes; `make explore` draws others.
settings.register_profile("mrpbench", deadline=None, derandomize=True)  # a busy machine is no defect
settings.register_profile("explore", deadline=None, print_blob=True)
settings.load_profile("mrpbench")


@pytest.fixture(scope="module")
def kept_workers() -> Iterator[None]:
    """Keep worker processes for all studies of a module, since starting them costs more than most runs."""
    with slots_of_this_process():
        yield


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Public maps and reference costs next to the checkout; tests that need them skip where they are absent."""
    folder = Path(__file__).parent.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("the public reference data are not next to the checkout")
    return folder
