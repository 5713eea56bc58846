"""The answer of a report: what it says first, and what it never says."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mrpbench_core.report.answer.answer import make_answer
from mrpbench_core.report.estimation.relation import Relation
from mrpbench_core.report.report import make_report

INVOCATION = """\
columns:
  planning.cost: {unit: s, better: lower, description: what it costs, primary: true, answers: duration, threshold: 1.0}
  execution.duration_s: {unit: s, better: lower, description: how long, primary: true, stage: execution,
    answers: duration, threshold: 1.0, threshold_share: 0.02}
  strain.wear: {unit: mm, better: lower, description: wear, primary: true, threshold: 2.0, stage: execution}
  own.speed: {unit: "", better: higher, description: no threshold, primary: true, threshold: null, stage: execution}
"""


def driven(record, planner, seed, duration, status="succeeded", **more):
    done = status == "succeeded"
    metrics = {"execution.duration_s": duration if done else None, "planning.solved": True} | more.pop("metrics", {})
    error = {} if done else {"error": {"stage": "execution", "message": status}}
    return record(planner, seed, status, metrics=metrics, **error, **more)


@pytest.fixture
def answer(results):
    """Return a function that answers for records."""
    return lambda records, invocation=INVOCATION: make_answer(make_report([results(records, invocation=invocation)]))


def topic(answer, title):
    return next(topic for topic in answer.whole.topics if topic.title.startswith(title))


def relations(topic):
    return {place.name: place.relation for place in topic.ranking.places}


def test_a_difference_that_nobody_notices_is_not_called_one(answer, record):
    """Each run of `b` plans 0.4 ms faster: significant, and of no use."""
    records = [record("a", seed, took=0.0010 + seed * 1e-5) for seed in range(20)]
    records += [record("b", seed, took=0.0006 + seed * 1e-5) for seed in range(20)]
    found = answer(records)
    cost = topic(found, "How long does planning take?")
    assert relations(cost) == {"b": None, "a": Relation.SLIGHT}
    assert "differ too little to matter" in cost.sentences[0]
    assert "noticeably worse" not in found.whole.headline


def test_a_noticeable_difference_leads(answer, record):
    records = [driven(record, "slow", seed, 100.0 + seed) for seed in range(12)]
    records += [driven(record, "fast", seed, 80.0 + seed / 2) for seed in range(12)]
    found = answer(records)
    duration = topic(found, "How long do the robots take?")
    assert [place.name for place in duration.ranking.places] == ["fast", "slow"]
    assert duration.sentences[1].startswith("slow is noticeably worse: 22.8 s more [")
    assert found.whole.headline == "fast comes out best: slow is noticeably worse in time."
    assert not found.whole.advice


@pytest.mark.parametrize("status", ["goals_missed", "execution_aborted", "contract_broken", "crashed"])
def test_failed_runs_never_look_better_than_honest_ones(answer, record, status):
    """`weak` arrives only where it is easy, and is quick there and worn little, since its other runs are cut short."""
    records = [driven(record, "honest", s, 50.0 + 10 * s, metrics={"strain.wear": 50.0 + s}) for s in range(12)]
    records += [
        driven(record, "weak", s, 40.0 + s / 9, "succeeded" if s < 6 else status, metrics={"strain.wear": 1.0 + s / 10})
        for s in range(12)
    ]
    found = answer(records)
    for title in ("Do the robots arrive?", "Is a plan found?", "How long", "Wear"):
        for entry in (entry for entry in found.whole.topics if entry.title.startswith(title)):
            assert [place.name for place in entry.ranking.places] == ["honest", "weak"]
            assert not any("weak has the best mean" in sentence for sentence in entry.sentences)
    assert "but it fails more often" in " ".join(topic(found, "Wear").sentences)


def test_a_broken_promise_counts_as_a_failure(answer, record):
    plan = {"problem": "p", "setting": "s", "assigns": False, "unsolvable": False, "lower_bound": None}
    records = []
    for seed in range(8):
        records.append(
            driven(record, "good", seed, 60.0, plan=plan | {"cost": 10.0, "factor": None}, scenario=f"s{seed}")
        )
        records.append(
            driven(record, "liar", seed, 50.0, plan=plan | {"cost": 12.0, "factor": 1.0}, scenario=f"s{seed}")
        )
    found = answer(records)
    assert relations(topic(found, "Do the")) == {"good": None, "liar": Relation.WORSE}
    assert "(8 promise broken)" in " ".join(topic(found, "Do the").sentences)
    assert topic(found, "How long").ranking.places[-1].estimate is None


def test_one_configuration_is_described_and_not_compared(answer, record):
    found = answer([driven(record, "a", seed, 60.0 + seed) for seed in range(6)])
    assert found.whole.headline == "There is one configuration, so nothing is compared."
    assert topic(found, "How long").sentences[0].startswith("62.5 s [")


def test_one_seed_gives_numbers_and_no_claim(answer, record):
    found = answer([driven(record, "a", 0, 60.0), driven(record, "b", 0, 10.0)])
    words = " ".join(found.lines(9))
    assert "How long do the robots take? 1 run is too few to compare b and a: 10.0 s to 60.0 s." in words
    assert "noticeably worse" not in words
    assert found.whole.headline == "1 run is too few to compare a and b: at least 6 are needed."
    assert "seed=0..29" in found.whole.advice


def test_runs_that_are_identical_are_called_so_with_what_that_means(answer, record):
    def records(**config):
        return [
            driven(record, p, s, 100.0 + s, took=0.01 * (s + (p == "b")), config={"planner": {"plugin": p}, **config})
            for p in "ab"
            for s in range(8)
        ]

    found = answer(records()).whole
    assert found.headline == "a and b gave identical results in each of 8 scenarios: the choice did not matter here."
    assert found.advice == "More robots, or a world with less room, may show a difference."
    assert {place.relation for place in topic(answer(records()), "Do the").ranking.places} == {None, Relation.IDENTICAL}
    words = " ".join(answer(records()).lines(9))
    assert "best mean" not in words
    assert "may show it" not in words
    found = answer(records(tasks={"plugin": "poisson", "rate": 1})).whole
    assert found.headline.endswith("the choice did not matter at this load.")
    assert "`mrpbench saturate`" in found.advice


def test_planning_that_takes_longer_is_said_of_runs_that_are_identical(answer, record):
    records = [driven(record, p, s, 9.0 + s, took=t + s / 99) for p, t in (("a", 1.0), ("b", 9.0)) for s in range(8)]
    assert answer(records).whole.headline == (
        "a and b gave identical results in each of 8 scenarios: the choice did not matter here; "
        "b is noticeably worse in planning time."
    )


def test_the_headline_says_which_questions_stay_open(answer, record):
    """Whether one of eight robots more arrives is open; that both are as quick where they arrive is not."""
    records = [driven(record, name, seed, 100.0 + seed + (name == "b") / 9) for name in "ab" for seed in range(8)]
    records[0] = driven(record, "a", 0, 0.0, "goals_missed")
    assert answer(records).whole.headline == (
        "a and b are practically the same in time and planning time; there is no clear difference in arrivals."
    )
    records = [driven(record, p, s, 100.0 + s * (1 + 9 * (s % 2 == (p == "a")))) for p in "ab" for s in range(8)]
    found = answer([{**entry, "timing": {}} for entry in records]).whole
    assert found.headline.endswith("there is no clear difference in time.")
    assert "seed=0..29" in found.advice


def test_an_interval_without_zero_that_no_test_confirms_is_said_to_be_that(answer, record):
    """Seven of eight robots arrive as late, so that the test has one pair; the interval says more."""
    took = {"a": [0.0, 0, 0, 0, 0, 9, 9, 9], "b": [0.0] * 8}
    records = [driven(record, p, s, 100 + s + took[p][s]) for p in "ab" for s in range(8)]
    words = " ".join(topic(answer(records), "How long do").sentences)
    assert words.startswith("There is no clear difference between b and a: ")
    assert words.endswith("], which the test does not confirm."), words


def test_differences_that_rounding_makes_are_zero(answer, record):
    records = [driven(record, p, s, v) for p, v in (("a", 0.0), ("b", -8.88e-16)) for s in range(2)]
    assert topic(answer(records), "How long do").sentences[0] == "2 scenarios are too few to compare b and a: 0 s."
    assert "000000" not in " ".join(answer(records).lines(9))


def test_every_setting_has_an_answer_and_all_have_one_together(answer, record):
    def entry(planner, robots, seed, duration):
        config = {"scenario": {"plugin": "random", "robots": robots}}
        return driven(
            record,
            planner,
            seed,
            duration,
            config={"planner": {"plugin": planner}, **config},
            scenario=f"{robots}-{seed}",
        )

    records = [entry(p, r, s, more + r + s) for p, more in (("a", 0), ("b", 30)) for r in (5, 9) for s in range(12)]
    found = answer(records)
    assert [part.name for part in found.parts] == ["robots=5", "robots=9"]
    assert [part.topics[1].ranking.ranked for part in (found.whole, *found.parts)] == [24, 12, 12]
    assert all(relations(part.topics[1])["b"] is Relation.WORSE for part in (found.whole, *found.parts))


def test_files_of_scenarios_are_samples(answer, record):
    def entry(planner, robots, file):
        scenario = {"plugin": "movingai", "file": {"path": f"{file}.scen", "sha256": str(file)}, "robots": robots}
        return driven(
            record,
            planner,
            file,
            10.0,
            config={"planner": {"plugin": planner}, "scenario": scenario},
            scenario=f"{file}-{robots}",
        )

    found = answer([entry(p, r, file) for p in "ab" for r in (5, 9) for file in range(6)])
    assert [(part.name, part.topics[0].ranking.ranked) for part in found.parts] == [("robots=5", 6), ("robots=9", 6)]


def test_settings_with_different_configurations_have_no_common_answer(answer, record):
    records = [driven(record, "a", seed, 10.0, scenario=f"a{seed}") for seed in range(6)]
    records += [driven(record, "b", seed, 50.0, scenario=f"b{seed}") for seed in range(6)]
    found = answer(records)
    assert found.whole is None
    assert len(found.parts) == 2
    assert "noticeably worse" not in " ".join(found.lines(9))


def test_without_scipy_configurations_are_ranked_and_not_compared(answer, record, monkeypatch):
    for module in ("report.report", "report.answer.answer", "report.answer.headline"):
        monkeypatch.setattr(f"mrpbench_core.{module}.has", lambda name: name != "scipy")
    records = [driven(record, p, s, more + s) for p, more in (("a", 90.0), ("b", 60.0)) for s in range(8)]
    found = answer(records)
    assert "needs SciPy (`pip install 'mrpbench[statistics]'`)" in found.whole.headline
    duration = topic(found, "How long do the robots")
    assert duration.sentences == ("b has the best mean: 63.5 s [61.9, 65.0].", "a is not compared with it.")


def test_a_metric_without_a_threshold_never_leads(answer, record):
    records = [
        driven(record, p, s, 60.0, metrics={"own.speed": v + s / 10})
        for p, v in (("a", 1), ("b", 9))
        for s in range(12)
    ]
    found = answer(records)
    speed = topic(found, "Speed")
    assert relations(speed) == {"b": None, "a": Relation.UNRATED}
    assert "no threshold says whether that matters" in " ".join(speed.sentences)
    assert "a is" not in found.whole.headline


values = st.lists(st.tuples(st.floats(10, 100), st.floats(10, 100), st.booleans()), min_size=5, max_size=9)


@settings(max_examples=6, deadline=None)
@given(values, st.randoms(use_true_random=False))
def test_claims_have_evidence_and_do_not_depend_on_the_order_of_records(
    tmp_path_factory, written, record, rows, shuffle
):
    records = [driven(record, "a", seed, one) for seed, (one, _, _) in enumerate(rows)]
    records += [
        driven(record, "b", seed, other, "succeeded" if ok else "goals_missed")
        for seed, (_, other, ok) in enumerate(rows)
    ]
    rest = records[1:]
    shuffle.shuffle(rest)
    mixed = [records[0], *rest]  # the first record decides which group comes first in tables, and the sign of intervals
    folder = tmp_path_factory.mktemp("answers")
    first, second = (
        make_answer(make_report([written(entries, folder / name, INVOCATION)]))
        for name, entries in (("one", records), ("other", mixed))
    )
    assert list(first.lines(9)) == list(second.lines(9))
    for entry in first.whole.topics:
        for place in entry.ranking.places:
            claimed = any(sentence.startswith(f"{place.name} is noticeably") for sentence in entry.sentences)
            if claimed:
                assert place.difference.low > 0 or place.difference.high < 0
                assert abs(place.difference.value) >= entry.ranking.column.threshold
            assert claimed == (place.relation in (Relation.WORSE, Relation.BETTER))


def test_units_are_written_once(answer, record):
    records = [driven(record, p, s, 60.0 + s, took=0.002) for p in "ab" for s in range(6)]
    words = " ".join(answer(records).lines(9))
    assert not re.search(r"\b(s|ms|%) \1\b", words)
    assert "2.00 ms" in words


def test_each_factor_is_answered_for_with_its_exceptions(answer, record):
    """Pairs of configurations that differ in both choices are not compared; the levels of each factor are."""

    def took(planner, controller, seed):
        slower = {("b", "dwb"): 20.0, ("b", "mppi"): 30.0, ("b", "rpp"): -9.0}.get((planner, controller), 0.0)
        return 50.0 + seed + slower + seed * slower / 99

    controllers = ("dwb", "mppi", "rpp")
    found = answer(
        [
            driven(record, p, seed, took(p, c, seed), config={"controller": {"plugin": c}}, tag=c)
            for p in ("a", "b")
            for c in controllers
            for seed in range(12)
        ]
    )
    planner, controller = found.effects
    assert planner.name == "planner, averaged over controller"
    assert planner.headline == "a comes out best: b is noticeably worse in time."
    (words,) = (" ".join(topic.sentences) for topic in planner.topics if topic.title.startswith("How long do the"))
    assert "over 12 scenarios" not in words
    assert "With rpp, b is noticeably better than a." in words
    assert "With dwb" not in words
    assert set(relations(controller.topics[-1])) == set(controllers)
    assert Relation.NOT_COMPARED not in relations(controller.topics[-1]).values()
    lines = list(found.lines(3))
    assert lines[0].startswith("planner, averaged over controller: a comes out best")
    assert any(line.startswith("all combinations: ") for line in lines)


def test_of_two_that_hardly_differ_the_difference_is_given_with_its_interval(answer, record):
    records = [driven(record, "a", seed, 100.0 + seed) for seed in range(8)]
    records += [driven(record, "b", seed, 100.2 + seed + 0.01 * seed) for seed in range(8)]
    (told,) = (sentence for sentence in topic(answer(records), "How long").sentences if " more " in sentence)
    value, low, high = map(float, re.findall(r"[0-9.]*[0-9]", told))
    assert told.startswith("b has ")
    assert low < value < high
    assert value == pytest.approx(0.235, abs=0.01)


LIFELONG = """\
columns:
  execution.time_blocked_s: {unit: s, better: lower, description: blocked, primary: true, stage: execution,
    answers: duration, threshold: 1.0}
  tasks.per_hour: {unit: 1/h, better: higher, description: done, primary: true, stage: execution, answers: throughput,
    threshold: 1.0}
  tasks.service_mean_s: {unit: s, better: lower, description: service time, primary: true, stage: execution,
    answers: service, threshold: 1.0}
  tasks.open_mean: {unit: "", better: lower, description: open, primary: true, stage: execution, answers: queue,
    threshold: 0.1}
"""


def test_tasks_over_time_are_answered_for_first_and_blocked_time_is_not_called_how_long_it_takes(answer, record):
    def served(planner, seed, service):
        values = {"per_hour": 120.0 + seed, "service_mean_s": service, "open_mean": service / 30}
        metrics = {f"tasks.{name}": value for name, value in values.items()} | {"execution.time_blocked_s": 5.0 + seed}
        config = {"planner": {"plugin": planner}, "tasks": {"plugin": "poisson"}}
        return driven(record, planner, seed, None, metrics=metrics, config=config)

    records = [served("a", seed, 100.0 + seed) for seed in range(8)]
    records += [served("b", seed, 130.0 + 2 * seed) for seed in range(8)]
    found = answer(records, LIFELONG)
    titles = [topic.title for topic in found.whole.topics]
    assert titles[:3] == ["How much gets done?", "How long does a task take?", "How many tasks are open?"]
    assert not {"How long do the robots take?", "Do the robots arrive?"} & set(titles)
    assert relations(topic(found, "How long does a task take?")) == {"a": None, "b": Relation.WORSE}
    assert "b is noticeably worse in service time and open tasks" in found.whole.headline
    assert any(line.startswith("- Time blocked: ") for line in found.lines(9))
