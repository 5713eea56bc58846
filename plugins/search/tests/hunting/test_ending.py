"""When a search ends, and what it counts."""

from types import SimpleNamespace

import numpy as np
from mrpbench_search.hunting.properties import Verdict
from mrpbench_search.hunting.search import Hunt


class Few:
    """Moves in a study that has few cases."""

    rng = np.random.default_rng(0)

    def __init__(self, cases):
        self._cases = [SimpleNamespace(key=str(number)) for number in range(cases)]

    def drawn(self, number):
        return self._cases[number]

    def new(self):
        return self.rng.choice(self._cases)

    def near(self, _):
        return self.new()


class Harmless:
    """Runs in which nothing fails."""

    def judge(self, cases, word, first):
        return [SimpleNamespace(case=case, left_out=False, verdict=Verdict(margin=float(case.key))) for case in cases]


def test_a_search_ends_where_a_study_has_no_further_cases_and_counts_each_once():
    hunt = Hunt(moves=Few(9), runs=Harmless(), announce=print)
    assert hunt.run() == "the study has no further cases"
    assert hunt.tried == 9
    assert not hunt.failures
