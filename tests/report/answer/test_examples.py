"""Runs to look at, chosen from those that have a recording."""

import pytest

from mrpbench_core.report.answer.answer import make_answer
from mrpbench_core.report.answer.examples import choose_examples
from mrpbench_core.report.report import make_report

INVOCATION = """\
columns:
  execution.duration_s: {unit: s, better: lower, description: how long, primary: true, stage: execution,
    answers: duration, threshold: 2.0}
"""


@pytest.fixture
def examples(results):
    """Return a function that chooses examples from records, and the planner, seed and repeat of each run.

    Runs whose seeds are `unrecorded` have no recording.
    """

    def choose(records, unrecorded=()):
        found = results(records, name=f"without {unrecorded}", invocation=INVOCATION)
        (found.folder.path / "recordings").mkdir()
        for record in records:
            if record["seed"] not in unrecorded:
                found.paths(record["run_id"]).recording.touch()
        report = make_report([found])
        return choose_examples(report, make_answer(report)), [name[:5] for name in report.runs.run_id]

    return choose


@pytest.fixture
def driven(record):
    """Return a function that makes the record of a run that took some seconds, or of one that failed."""

    def make(planner, seed, took, message="", **more):
        status = "goals_missed" if message else "succeeded"
        error = {"error": {"stage": "execution", "message": message}} if message else {}
        metrics = {"execution.duration_s": None if message else took, "planning.solved": True}
        return record(planner, seed, status, metrics=metrics, **error, **more)

    return make


def chosen(part, run_ids):
    return {example.label: (run_ids[example.run], example.text) for example in part.runs}


def test_runs_that_only_plan_have_no_motion_to_look_at_but_failures(results, driven):
    columns = INVOCATION.replace("stage: execution", "stage: planning")
    records = [driven("a", seed, 10.0 + seed) for seed in range(3)]
    for more, labels in (([], []), ([driven("a", 3, 0.0, "no plan")], ["failed"])):
        found = results(records + more, name=f"plans {labels}", invocation=columns)
        (found.folder.path / "recordings").mkdir()
        for entry in records + more:
            found.paths(entry["run_id"]).recording.touch()
        report = make_report([found])
        chosen = choose_examples(report, make_answer(report))
        assert [example.label for part in chosen for example in part.runs] == labels


def test_the_longest_the_typical_and_the_shortest_run_are_chosen(examples, driven):
    (part,), run_ids = examples([driven("a", seed, took) for seed, took in enumerate([30.0, 10.0, 50.0, 20.0, 90.0])])
    assert chosen(part, run_ids) == {
        "longest": ("a-4-0", "all runs, seed 4: 90.0 s"),
        "typical": ("a-0-0", "all runs, seed 0: 30.0 s"),
        "shortest": ("a-1-0", "all runs, seed 1: 10.0 s"),
    }
    assert [example.label for example in part.runs] == ["longest", "typical", "shortest"]
    assert part.contrast is None


def test_the_next_one_takes_the_place_of_a_run_without_recording(examples, driven):
    records = [driven("a", seed, took) for seed, took in enumerate([30.0, 10.0, 50.0, 20.0, 90.0])]
    (part,), run_ids = examples(records, unrecorded=(0, 4))
    assert [run_ids[example.run] for example in part.runs] == ["a-2-0", "a-3-0", "a-1-0"]
    assert examples(records, unrecorded=range(5))[0] == []


def test_no_run_is_chosen_twice_and_repeats_are_named(examples, driven):
    (part,), run_ids = examples([driven("a", 0, 10.0), driven("a", 0, 12.0, repeat=1)])
    assert chosen(part, run_ids) == {
        "longest": ("a-0-1", "all runs, seed 0, repeat 1: 12.0 s"),
        "typical": ("a-0-0", "all runs, seed 0: 10.0 s"),
    }


def test_a_run_of_the_most_frequent_failure_comes_first_with_its_reason(examples, driven, record):
    records = [driven("a", seed, 10.0 + seed) for seed in range(4)]
    records += [record("a", 4, "crashed", error={"stage": "planning", "message": "once"})]
    records += [driven("a", seed, None, "stood " * 30) for seed in (5, 6)]
    (part,), run_ids = examples(records)
    first = part.runs[0]
    assert (first.label, run_ids[first.run]) == ("failed", "a-5-0")
    assert first.text.startswith("all runs, seed 5: goals missed: stood stood")
    assert first.text.endswith("stood…")
    assert len(first.text.partition("missed: ")[2]) <= 80


def test_runs_of_the_scenario_that_took_another_configuration_most_time_more_are_a_contrast(examples, driven):
    more = [1.0, 9.0, 5.0, 0.0, 7.0, 3.0]
    records = [driven("a", seed, 20.0 + seed) for seed in range(6)]
    records += [driven("b", seed, 20.0 + seed + added) for seed, added in enumerate(more)]
    (part,), run_ids = examples(records)
    assert (run_ids[part.contrast.first], run_ids[part.contrast.second]) == ("a-1-0", "b-1-0")
    assert part.contrast.text == "b took 9.00 s more than a in the same scenario (seed 1)"
    (part,), run_ids = examples(records, unrecorded=(1,))
    assert (run_ids[part.contrast.first], run_ids[part.contrast.second]) == ("a-4-0", "b-4-0")


@pytest.mark.parametrize(("added", "noticed"), [(1.5, False), (2.0, True)])
def test_a_contrast_is_noticeable(examples, driven, added, noticed):
    records = [driven("a", seed, 20.0) for seed in range(4)]
    records += [driven("b", seed, 20.0 + added * (seed == 2)) for seed in range(4)]
    (part,), _ = examples(records)
    assert (part.contrast is not None) == noticed


def test_each_of_the_first_two_settings_has_its_runs(examples, driven):
    records = [
        driven(
            planner,
            seed,
            10.0 * robots + seed,
            scenario=f"{robots}-{seed}",
            config={"scenario": {"plugin": "random", "robots": robots}},
        )
        for planner in "ab"
        for robots in (2, 4, 6)
        for seed in range(3)
    ]
    parts, _ = examples(records)
    assert {part.name: [example.text for example in part.runs] for part in parts} == {
        "robots=2": ["b, seed 2: 22.0 s", "a, seed 1: 21.0 s", "a, seed 0: 20.0 s"],
        "robots=4": ["b, seed 2: 42.0 s", "a, seed 1: 41.0 s", "a, seed 0: 40.0 s"],
    }
