"""Numbers of pairs that show a difference."""

import numpy as np
import pytest
from scipy.stats import wilcoxon

from mrpbench_core.report.statistics.sample_size import POWER, pairs_needed


def test_so_many_pairs_show_a_normal_difference_with_the_stated_probability():
    rng = np.random.default_rng(0)
    needed = pairs_needed(rng.normal(0.3, 1, 400), 0.5, 0.05)
    shown = np.mean([wilcoxon(rng.normal(0.5, 1, needed)).pvalue < 0.05 for _ in range(300)])
    assert shown == pytest.approx(POWER, abs=0.06)


def test_pairs_without_noise_need_as_many_as_any_test():
    assert pairs_needed(np.zeros(20), 0.5, 0.05) == 15
    assert pairs_needed(np.zeros(1), 0.5, 0.05) is None
