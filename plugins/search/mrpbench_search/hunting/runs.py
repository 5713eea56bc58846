"""Asks for the runs of cases, and judges them."""

from collections.abc import Sequence
from pathlib import Path

import attrs

from mrpbench_core.engine.loading.runs import StudyRun, StudyRuns
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.runs.status import LEFT_OUT
from mrpbench_core.store.results import Results
from mrpbench_search.asking.requests import Requests
from mrpbench_search.asking.variants import read_variants
from mrpbench_search.hunting.cases import Case
from mrpbench_search.hunting.properties import METRICS, Property, Record, Verdict
from mrpbench_search.hunting.reasons import reason_of, robots_of, signature


@attrs.frozen(kw_only=True)
class Judged:
    """A case, its runs and what they show."""

    case: Case
    records: tuple[Record, ...]
    verdict: Verdict

    @property
    def left_out(self) -> bool:
        """Tell whether a run of the case was refused, for example since a robot starts in a doorway."""
        return any(record["status"] in LEFT_OUT for record in self.records)

    @property
    def size(self) -> tuple[int, int, float]:
        """Robots, tasks and faults, and seconds of faults: what shrinking makes smaller."""
        case = self.case
        lasting = sum(float(event.get("lasts") or 0) for event in case.events)
        return case.robots, len(case.tasks) + len(case.events) + len(case.crowds), lasting


@attrs.define(kw_only=True)
class CaseRuns:
    """Runs of cases, each done once."""

    study: StudyRuns
    candidates: Sequence[StudyRun]
    """A run of each candidate."""
    tried: Property
    requests: Requests
    folder: Path
    """Where scenario files are written."""
    results: Results | None = attrs.field(default=None, init=False)
    """Of the last step."""
    _known: dict[str, Judged] = attrs.field(factory=dict, init=False)

    def judge(self, cases: Sequence[Case], word: str, first: int = 1) -> list[Judged]:
        """Return what the runs of some cases show, after those without a record were done.

        Args:
            cases: to judge.
            word: names them in progress, with numbers from `first`.
            first: number of the first one.

        Raises:
            SearchEnded: as of `Requests.results`.
        """
        new = {case.key: case for case in cases if case.key not in self._known}
        if new:
            self._judge(new, [{word: first + place} for place in range(len(new))])
        return [self._known[case.key] for case in cases]

    def signature(self, judged: Judged, kind: str) -> tuple[str, str]:
        """Return what tells a failure from others, and why it happened."""
        assert self.results is not None
        results = self.results_of(judged)
        reason = reason_of(kind, self.tried, judged.records, results)
        known = robots_of(judged.records[0], results)
        names = known or tuple(f"robot_{index}" for index in range(judged.case.robots))
        return signature(kind, reason, names), reason

    def results_of(self, judged: Judged) -> Results:
        """The records of a case, with access to its recordings."""
        assert self.results is not None
        return Results(self.results.folder, only=[record["run_id"] for record in judged.records])

    def as_assigned(self, judged: Judged) -> Case:
        """Return the case with its goals in the order of the robots that got them in its first run.

        `Case.without_robot` then leaves out a robot with its own goal, and an assigner of least cost, or one that takes
        the cheapest pairs first, assigns the others as before.
        """
        case, tasks = judged.case, judged.case.scenario.tasks
        if case.stream is not None or len(tasks) != case.robots:
            return case
        try:
            recording = self.results_of(judged).recording(judged.records[0]["run_id"])
        except InputError:  # the run was not recorded
            return case
        try:
            assigned = recording.instance().assigned
        finally:
            recording.close()
        return case if assigned is None else case.with_tasks(tuple(tasks[index] for index in assigned))

    def points(self, case: Case) -> list[StudyRun]:
        """Return the runs of a case: one for each candidate."""
        return [study.runs[0] for study in self._variants([case], [{}])]

    def _variants(self, cases: Sequence[Case], labels: Sequence[dict[str, int]]) -> list[StudyRuns]:
        """The runs of some cases for each candidate."""
        changes = [{**case.changes(self.folder), "recording.keep": "all"} for case in cases]
        return [
            read_variants(self.study, each, [one | {"metrics": _metrics(each)} for one in changes], labels)
            for each in self.candidates
        ]

    def _judge(self, cases: dict[str, Case], labels: list[dict[str, int]]) -> None:
        by_candidate = self._variants(list(cases.values()), labels)
        study = attrs.evolve(
            by_candidate[0],
            runs=tuple(run for each in by_candidate for run in each.runs),
            columns={name: column for each in by_candidate for name, column in each.columns.items()},
        )
        self.results = self.requests.results(study, study.runs)
        for place, (key, case) in enumerate(cases.items()):
            records = tuple(self.results[each.runs[place].run_id] for each in by_candidate)
            self._known[key] = Judged(case=case, records=records, verdict=self.tried.judge(records))


def _metrics(candidate: StudyRun) -> list[dict[str, object]]:
    """The metrics of the study, and those from which failures are read."""
    given = list(candidate.canonical["metrics"])
    named = {block["plugin"] for block in given}
    blocks = any(event["kind"] == "blocked" for event in candidate.canonical["faults"]["events"])
    movers = ("people",) if candidate.canonical["crowds"] or blocks else ()
    return [*given, *({"plugin": name} for name in (*METRICS, *movers) if name not in named)]
