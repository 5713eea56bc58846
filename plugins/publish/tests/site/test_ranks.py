"""Ranks say no more than the paired comparisons decide."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mrpbench_publish.site import ranks
from mrpbench_publish.site.ranks import rank_groups

NAMES = ("a", "b", "c")


def comparison(first, second, difference, better="lower"):
    """The second compared with the first: shown to differ unless the difference is 0."""
    return SimpleNamespace(
        first=first,
        second=second,
        column=SimpleNamespace(better=better),
        paired=SimpleNamespace(difference=SimpleNamespace(value=difference)),
    )


@pytest.fixture(autouse=True)
def _shown(monkeypatch):
    monkeypatch.setattr(ranks, "is_shown", lambda entry: entry.paired.difference.value != 0)


def test_without_a_shown_difference_nothing_is_told_apart():
    found = rank_groups(NAMES, [comparison("a", "b", 0.0)])
    assert set(map(str, found.values())) == {"no clear difference"}


def test_each_shown_difference_narrows_two_ranks():
    found = rank_groups(NAMES, [comparison("a", "b", 2.0)])
    assert {name: str(rank) for name, rank in found.items()} == {"a": "1–2", "b": "2–3", "c": "no clear difference"}


def test_more_is_better_where_the_column_says_so():
    found = rank_groups(NAMES[:2], [comparison("a", "b", 2.0, "higher")])
    assert (str(found["a"]), str(found["b"])) == ("2", "1")


@given(st.permutations(range(6)))
def test_a_complete_order_gives_the_ranks_of_sorting(values):
    names = [str(value) for value in values]
    pairs = [comparison(a, b, int(b) - int(a)) for i, a in enumerate(names) for b in names[i + 1 :]]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ranks, "is_shown", lambda entry: True)
        assert {name: str(rank) for name, rank in rank_groups(names, pairs).items()} == {
            name: str(int(name) + 1) for name in names
        }
