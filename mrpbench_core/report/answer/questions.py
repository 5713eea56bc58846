"""The questions that a report answers, and the columns that answer them."""

from collections.abc import Sequence
from typing import get_args

import attrs
import numpy as np

from mrpbench_core.api.metric import Column, Question
from mrpbench_core.report.reading.axes import word
from mrpbench_core.report.reading.runs import Runs

TITLES: dict[str, str] = {
    "throughput": "How much gets done?",
    "service": "How long does a task take?",
    "queue": "How many tasks are open?",
    "arrival": "Do the robots arrive?",
    "duration": "How long do the robots take?",
    "planning": "How long does planning take?",
    "proximity": "How near do robots come to each other?",
}
NOUNS: dict[str, str] = {
    "throughput": "throughput",
    "service": "service time",
    "queue": "open tasks",
    "arrival": "arrivals",
    "duration": "time",
    "planning": "planning time",
    "proximity": "distance between robots",
}
"""What a headline calls the questions."""
_OTHERWISE = {
    ("arrival", "plans"): ("Is a plan found?", "plans found"),
    ("arrival", "tasks"): ("Do all runs succeed?", "success"),
    ("duration", "plans"): ("How long are the plans?", "length of the plans"),
}
"""Title and noun where robots only plan, and where they have tasks over time."""


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
    topics, kind = [], _topic_group(runs)
    for question in get_args(Question):
        matching = [column for column in having if column.answers == question]
        # Rates and primary columns; others only if nothing else answers.
        matching = [column for column in matching if column.primary or question == "arrival"] or matching
        if not matching:
            continue
        # What happened counts more than what was planned.
        ranking = next((c for c in matching if c.stage == "execution"), matching[0])
        others = (c for c in matching if c is not ranking and (c.stage == ranking.stage or question == "arrival"))
        title, noun = _OTHERWISE.get((question, kind), (TITLES[question], NOUNS[question]))
        if (question == "duration" and kind == "tasks") or (question == "planning" and ranking.unit != "s"):
            title, noun = _named(ranking)  # runs with tasks over time end when they are told to
        topics.append(Topic(title=title, noun=noun, columns=(ranking, *others)))
    unasked = [column for column in having if column.primary and column.answers is None]
    return [*topics, *(Topic(title=_named(column)[0], noun=_named(column)[1], columns=(column,)) for column in unasked)]


def has_tasks(runs: Runs) -> bool:
    """Tell whether all runs have tasks over time."""
    return all(word(config.get("tasks")) != "none" for config in runs.configs)


def words_of(column: Column) -> str:
    """Return the name of a column in words: `time blocked` for `execution.time_blocked_s`."""
    name = column.name.rpartition(".")[2].removesuffix(f"_{column.unit}" if column.unit else "")
    return name.replace("_", " ")


def _named(column: Column) -> tuple[str, str]:
    words = words_of(column)
    return words[0].upper() + words[1:], words


def _topic_group(runs: Runs) -> str:
    if all(word(config.get("simulator", "unknown")) == "none" for config in runs.configs):
        return "plans"
    return "tasks" if has_tasks(runs) else "drives"
