"""The section that begins the page: the answer in words, a picture for each question, and the runs to look at."""

from collections.abc import Sequence
from html import escape

from mrpbench_core.report.answer.amounts import reading
from mrpbench_core.report.answer.answer import Answer, SettingAnswer, TopicAnswer
from mrpbench_core.report.html.cells import breakable, prose
from mrpbench_core.report.html.ranking import plot_ranking

OPEN = 12
"""Settings whose questions are drawn; of more, only their first sentences are listed."""
SAID = 4
"""Sentences of an answer that are shown at once."""


def answer_section(answer: Answer) -> str:
    """Return the questions of all runs together, and of each setting."""
    parts = [f"<h3>{escape(_title(effect))}</h3>{_cards(effect)}" for effect in answer.effects]
    if answer.whole is not None:
        cards = _cards(answer.whole)
        parts.append(_folded("All combinations", answer.whole.headline, cards) if answer.effects else cards)
    if answer.parts:
        title = "In each setting" if answer.whole else "Answers by setting, which have different configurations"
        parts.append(f"<h3>{title}</h3>{_settings(answer.parts)}")
    return "".join(parts)


def headline(answer: Answer) -> str:
    """Return the first sentence of the page."""
    if answer.effects:
        return "<br>".join(f"<b>{escape(_title(effect))}:</b> {prose(effect.headline)}" for effect in answer.effects)
    if answer.whole is not None:
        return prose(answer.whole.headline)
    return "The settings have different configurations, so each has an answer of its own."


def advice(answer: Answer) -> str:
    """Return what may show more than these runs do."""
    parts = answer.effects or ((answer.whole,) if answer.whole else ())
    return "".join(
        f'<p class="advice">{prose(text)}</p>' for text in dict.fromkeys(part.advice for part in parts) if text
    )


def _settings(parts: Sequence[SettingAnswer]) -> str:
    """Each setting as an element that unfolds."""
    drawn = "".join(_folded(part.name, part.headline, _cards(part)) for part in parts[:OPEN])
    rest = "".join(f"<li><b>{escape(part.name)}</b> {escape(part.headline)}</li>" for part in parts[OPEN:])
    if not rest:
        return drawn
    return f"{drawn}<details><summary>{len(parts) - OPEN} more settings</summary><ul>{rest}</ul></details>"


def _title(effect: SettingAnswer) -> str:
    return effect.name[0].upper() + effect.name[1:]


def _folded(name: str, headline: str, cards: str) -> str:
    summary = f"<summary><b>{escape(name)}</b> <span>{escape(headline)}</span></summary>"
    return f'<details class="part">{summary}{cards}</details>'


def _cards(answer: SettingAnswer) -> str:
    return f'<div class="cards">{"".join(map(_card, answer.topics))}</div>'


def _card(topic: TopicAnswer) -> str:
    says, rest = (escape(" ".join(part)) for part in (topic.sentences[:SAID], topic.sentences[SAID:]))
    rest = f"<details><summary>Further differences</summary><p>{rest}</p></details>" if rest else ""
    column = topic.ranking.column
    note = f"<code>{breakable(column.name)}</code>: {prose(column.description)}. {escape(reading(topic.ranking))}"
    return (
        f'<article class="card"><h3>{escape(topic.title)}</h3><p class="says">{says}</p>'
        f'{plot_ranking(topic.ranking)}{rest}<p class="note">{note}</p></article>'
    )
