"""Small building files."""

import pytest
from mrpbench_worlds_standard.rmf import Rmf


@pytest.fixture
def load(tmp_path):
    def read(text, **options):
        file = tmp_path / "hut.building.yaml"
        file.write_text(text)
        return Rmf(file=file, **options).load()

    return read
