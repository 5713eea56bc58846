"""The answers of a report, for all settings together and for each of them."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import attrs

from mrpbench_core.api.metric import Column
from mrpbench_core.files.extras import has
from mrpbench_core.report.answer.headline import headline
from mrpbench_core.report.answer.questions import Topic, find_topics, has_tasks, words_of
from mrpbench_core.report.answer.ranking import Compared, Ranking, by_names, is_identical, rank
from mrpbench_core.report.answer.wording import exceptions, sentences
from mrpbench_core.report.estimation.comparison import Comparison, compare_settings
from mrpbench_core.report.estimation.effects import find_effects
from mrpbench_core.report.estimation.groups import Setting, merge_settings
from mrpbench_core.report.estimation.relation import Relation
from mrpbench_core.report.reading.runs import Runs
from mrpbench_core.report.report import Report

MOST_MERGED = 24
"""Configurations up to which several settings are also compared together: each pair is a test of every column."""
SAMPLES = "scenario.file"
"""Files of scenarios are samples of one condition, as the 25 files of a map of the MovingAI benchmarks are."""


@attrs.frozen(kw_only=True)
class TopicAnswer:
    """The answer to one question."""

    title: str
    ranking: Ranking
    sentences: tuple[str, ...]

    @property
    def line(self) -> str:
        """The answer as a line of text."""
        end = "" if self.title.endswith("?") else ":"
        return f"- {self.title}{end} {' '.join(self.sentences)}"


@attrs.frozen(kw_only=True)
class SettingAnswer:
    """The answers for one setting, or for several together."""

    name: str
    setting: Setting
    headline: str
    advice: str
    """What may show more than these runs do; empty if something is shown."""
    topics: tuple[TopicAnswer, ...]


@attrs.frozen(kw_only=True)
class Answer:
    """What a report says first."""

    whole: SettingAnswer | None
    """Of all runs together; None if the settings have different configurations."""
    parts: tuple[SettingAnswer, ...]
    """Of each setting, if there are several."""
    effects: tuple[SettingAnswer, ...] = ()
    """Of each factor of the study, averaged over the others, if there are several factors."""

    def lines(self, parts: int) -> Iterator[str]:
        """Yield the answer as lines of text, with at most this number of settings."""
        for effect in self.effects:
            yield f"{effect.name}: {effect.headline}"
            yield from filter(None, [effect.advice])
            yield from (topic.line for topic in effect.topics)
        for number, part in enumerate([*([self.whole] if self.whole else ()), *self.parts[:parts]]):
            name = part.name or ("all settings together" if self.parts else "")
            name = name or ("all combinations" if self.effects else "")
            yield f"{name}: {part.headline}" if name else part.headline
            yield from filter(None, [part.advice if number == 0 and not self.effects else ""])
            for topic in part.topics if number == 0 and not self.effects else ():
                yield topic.line
        if len(self.parts) > parts:
            yield f"… and {len(self.parts) - parts} more in the page and in --json"


def make_answer(report: Report) -> Answer:
    """Answer the questions for which the runs have values."""
    runs, topics = report.runs, find_topics(report.runs, report.compared)
    settings, comparisons = report.settings, report.comparisons
    columns = [column for topic in topics for column in topic.columns] if has("scipy") else []
    few = len(settings[0].groups) <= MOST_MERGED

    def answers(settings: Sequence[Setting], comparisons: Sequence[Comparison]) -> list[SettingAnswer]:
        return [_answer(runs, setting, topics, by_names(comparisons, setting.name)) for setting in settings]

    if (
        few
        and len(settings) > 1
        and (merged := merge_settings(runs, settings, SAMPLES))
        and len(merged) < len(settings)
    ):
        settings = tuple(merged)
        comparisons = tuple(compare_settings(runs, settings, columns))
    parts = answers(settings, comparisons)
    if len(parts) == 1:
        return Answer(whole=parts[0], parts=(), effects=_effects(runs, settings[0], topics, columns, comparisons))
    if not few or (whole := merge_settings(runs, settings)) is None:
        return Answer(whole=None, parts=tuple(parts))
    comparisons = tuple(compare_settings(runs, whole, columns))
    (together,) = answers(whole, comparisons)
    return Answer(whole=together, parts=tuple(parts), effects=_effects(runs, whole[0], topics, columns, comparisons))


def _effects(
    runs: Runs, setting: Setting, topics: Sequence[Topic], columns: Sequence[Column], comparisons: Sequence[Comparison]
) -> tuple[SettingAnswer, ...]:
    """Answer for each factor of a setting; p is adjusted for the tests of all of them."""
    effects = find_effects(setting)
    tests = compare_settings(runs, [effect.setting for effect in effects], columns)
    within = by_names(comparisons, setting.name)
    return tuple(
        _answer(
            runs,
            effect.setting,
            topics,
            by_names(tests, effect.setting.name),
            partial(exceptions, effect, within),
            "choices",
        )
        for effect in effects
    )


def _answer(
    runs: Runs,
    setting: Setting,
    topics: Sequence[Topic],
    compared: Compared,
    further: Callable[[Ranking], list[str]] = lambda _: [],
    noun: str = "configurations",
) -> SettingAnswer:
    answers = []
    for topic in topics:
        first, *others = (rank(runs, setting, column, compared) for column in topic.columns)
        more = (
            f"{words_of(ranking.column).capitalize()}: {' '.join(sentences(ranking))}"
            for ranking in others
            if ranking.having(Relation.WORSE, Relation.BETTER)
        )
        answers.append(
            TopicAnswer(title=topic.title, ranking=first, sentences=(*sentences(first), *further(first), *more))
        )
    asked = [(topic.noun, entry.ranking) for topic, entry in zip(topics, answers, strict=True)]
    head = headline(asked, noun, identical=is_identical(compared), tasks=has_tasks(runs))
    return SettingAnswer(
        name=setting.name, setting=setting, headline=head.sentence, advice=head.advice, topics=tuple(answers)
    )
