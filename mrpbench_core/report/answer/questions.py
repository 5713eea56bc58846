"""The questions that a report answers, and the columns that answer them."""

from collections.abc import Sequence
from typing import get_args

import attrs
import numpy as np

from mrpbench_core.api.metric import Column, Question
from mrpbench_core.report.reading.axes import word
from mrpbench_core.report.reading.columns import heading
from mrpbench_core.report.reading.runs import Runs

TITLES: dict[str, str] = {
    "throughput": "How much gets done?",
    "service": "How long does a task take?",
    "queue": "How many tasks are open?",
    "arrival": "Do the robots arrive?",
    "duration": "How long does it take?",
    "planning": "What does planning cost?",
    "proximity": "How near do robots come?",
}
NOUNS: dict[str, str] = {
    "throughput": "throughput",
    "service": "service time",
    "queue": "open tasks",
    "arrival": "arrivals",
    "duration": "time",
    "planning": "cost of planning",
    "proximity": "distance between robots",
}
"""What a headline calls the questions."""
_PLANS_ONLY = "Is a plan found?", "plans found"


@attrs.frozen(kw_only=True)
class Topic:
    """A question, and what answers it."""

    title: str
    noun: str
    """For sentences about several questions."""
    columns: tuple[Column, ...]
    """The first one ranks the configurations."""


def find_topics(runs: Runs, compared: Sequence[Column]) -> list[Topic]:
    """Return the questions for which there are values: those of `Question`, then each primary column that answers none.

    Args:
        runs: which hold the values.
        compared: the columns that a report compares.
    """
    having = [column for column in compared if np.isfinite(runs.values[column.name]).any()]
    topics = []
    for question in get_args(Question):
        found = [column for column in having if column.answers == question]
        # Rates and primary columns; others only if nothing else answers.
        found = [column for column in found if column.primary or question == "arrival"] or found
        if not found:
            continue
        # What happened counts more than what was planned.
        ranking = next((c for c in found if c.stage == "execution"), found[0])
        others = (c for c in found if c is not ranking and (c.stage == ranking.stage or question == "arrival"))
        named = TITLES[question], NOUNS[question]
        if question == "duration" and any(column.answers == "service" for column in having):
            named = heading(ranking), ranking.name  # runs with tasks over time end when they are told to
        title, noun = _PLANS_ONLY if question == "arrival" and _never_driven(runs) else named
        topics.append(Topic(title=title, noun=noun, columns=(ranking, *others)))
    own = (column for column in having if column.primary and column.answers is None)
    return [*topics, *(Topic(title=heading(column), noun=column.name, columns=(column,)) for column in own)]


def _never_driven(runs: Runs) -> bool:
    return all(word(config.get("simulator", "unknown")) == "none" for config in runs.configs)
