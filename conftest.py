"""Fixtures that every test folder shares."""

import secrets
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from mrpbench_core.engine.processes import slots

# The same examples in every run, so that a change is judged by what it changes; `make explore` draws others.
settings.register_profile("mrpbench", deadline=None, derandomize=True)  # a busy machine is no defect
settings.register_profile("explore", deadline=None, print_blob=True)
settings.load_profile("mrpbench")


@pytest.fixture(scope="session")
def worker_slots() -> Iterator[str]:
    """Worker slots that modules share."""
    key = secrets.token_hex(8)
    yield key
    slots.close_slots(key)


@pytest.fixture(scope="module")
def kept_workers(worker_slots: str) -> Iterator[None]:
    """Keep worker processes for all studies of a module, since starting them costs more than most runs."""
    token = slots._OPEN.set(worker_slots)
    yield
    slots._OPEN.reset(token)


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Public maps and reference costs next to the checkout; tests that need them skip where they are absent."""
    folder = Path(__file__).parent.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("the public reference data are not next to the checkout")
    return folder
