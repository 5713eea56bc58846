"""Fixtures that every test folder shares."""

from pathlib import Path

import pytest
from hypothesis import settings

settings.register_profile("mrpbench", deadline=None)  # a busy machine is no defect
settings.load_profile("mrpbench")


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Public maps and reference costs next to the checkout; tests that need them skip where they are absent."""
    folder = Path(__file__).parent.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("the public reference data are not next to the checkout")
    return folder
