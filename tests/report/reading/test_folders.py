"""One number has one name: values that older versions stored under another one are read under it."""

import numpy as np
import pytest

from mrpbench_core.report.reading.folders import read_folders
from mrpbench_core.report.report import make_report

COUNTED = "execution.robot_contacts"
FORMER = "contact.robot_count"
INVOCATION = f"columns:\n  {FORMER}: {{unit: '', better: lower}}\n  {COUNTED}: {{unit: '', better: lower}}\n"


@pytest.fixture
def read(results, record):
    def read(*metrics):
        records = [record(seed=seed, metrics=entry) for seed, entry in enumerate(metrics)]
        return results(records, invocation=INVOCATION)

    return read


def test_values_under_a_former_name_fill_gaps(read):
    runs, _ = read_folders([read({FORMER: 2, COUNTED: 2}, {FORMER: 3}, {COUNTED: 4}, {})])
    assert FORMER not in runs.values
    np.testing.assert_array_equal(runs.values[COUNTED], [2, 3, 4, np.nan])


def test_values_that_differ_are_kept_apart(read):
    runs, _ = read_folders([read({FORMER: 2, COUNTED: 1}, {FORMER: 3})])
    assert runs.values[FORMER].tolist() == [2, 3]
    np.testing.assert_array_equal(runs.values[COUNTED], [1, np.nan])


def test_a_former_name_may_be_asked_for(read):
    for entry in ({COUNTED: 4}, {FORMER: 4}):
        assert [column.name for column in make_report([read(entry)], [FORMER]).columns] == [COUNTED]
