"""The section that begins the page: rankings as markup."""

import re
from html import escape

import pytest

from mrpbench_core.report.answer.answer import make_answer
from mrpbench_core.report.html.page import write_report
from mrpbench_core.report.html.ranking import SHOWN
from mrpbench_core.report.report import make_report


def written_page(report, folder):
    file = folder / "report.html"
    write_report(report, file)
    return file.read_text()


def rows(text, title):
    card = next(card for card in re.findall(r'<article class="card">.*?</article>', text, re.DOTALL) if title in card)
    return re.findall(r'<tr class="([a-z ]+)"><td class="place">(\d+)</td><th scope="row">([^<]*)</th>', card)


@pytest.fixture(scope="module")
def page_text(page):
    """Return the text of the page."""
    return page.read_text()


def test_the_page_says_what_the_terminal_says(page_text, study):
    answer = make_answer(make_report([study], ["planning.cost", "timing.planning_s", "timing.planning_par2_s"]))
    assert escape(answer.whole.headline) in page_text
    for topic in answer.whole.topics:
        assert escape(topic.sentences[0]) in page_text


def test_configurations_are_ranked_with_their_relation_to_the_first(page_text):
    assert rows(page_text, "How long does planning take?") == [
        ("first", "1", "cbs"),
        ("worse", "2", "&lt;b&gt;bad&lt;/b&gt;"),
    ]


def test_configurations_with_the_same_mean_share_a_place(results, record, tmp_path):
    records = [
        record(name, seed, took=took) for name, took in [("a", 1.0), ("b", 1.0), ("c", 9.0)] for seed in range(3)
    ]
    text = written_page(make_report([results(records)]), tmp_path)
    assert [number for _, number, _ in rows(text, "How long does planning take?")] == ["1", "1", "3"]
    assert re.findall(r'class="tag"[^>]*>(\w+)', text.split("How long does planning take?")[1])[:3] == [
        "best",
        "identical",
        "too",
    ]


def test_one_run_of_each_is_called_too_few_in_the_picture_too(results, record, tmp_path):
    text = written_page(make_report([results([record("a", 0, took=1.0), record("b", 0, took=9.0)])]), tmp_path)
    card = text.split("How long does planning take?")[1].split("</article>")[0]
    assert re.findall(r'class="tag"[^>]*>([^<]*)', card) == ["best mean", "too few to compare"]
    assert "Mean over 1 run." in card


def test_a_ranking_of_many_draws_some_and_counts_the_rest(results, record, tmp_path):
    records = [record(f"p{number}", seed, took=1.0 + number) for number in range(14) for seed in range(2)]
    text = written_page(make_report([results(records)]), tmp_path)
    assert len(rows(text, "How long does planning take?")) == SHOWN
    assert f"{14 - SHOWN} more configurations are in the tables." in text


def test_marks_are_within_their_picture(page_text):
    numbers = re.findall(
        r' (?:x1|x2|cx|x)="(-?[\d.]+)"', "".join(re.findall(r'class="ranking">.*?</table>', page_text))
    )
    assert numbers
    assert all(0 <= float(number) <= 220 for number in numbers)


def test_one_configuration_without_values_has_a_page(results, record, tmp_path):
    text = written_page(
        make_report([results([record("a", seed, "plan_timeout", took=None) for seed in range(3)])]), tmp_path
    )
    assert "There is one configuration, so nothing is compared." in text
    assert "3 plan timeout" in text
