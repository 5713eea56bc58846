"""Suggest the known word that a user probably meant."""

import difflib
from collections.abc import Iterable


def closest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that is most similar to `word`, or None if none is similar."""
    return next(iter(difflib.get_close_matches(word, list(known), n=1)), None)


def did_you_mean(word: str, known: Iterable[str], otherwise: str | None = None) -> str | None:
    """Return a hint that names the most similar known word, or else `otherwise`."""
    nearest = closest(word, known)
    return otherwise if nearest is None else f"did you mean {nearest!r}?"


def suggest(word: str, known: Iterable[str], introduction: str = "there are") -> str:
    """Return a hint that names the most similar known word, or else all of them after `introduction`."""
    known = list(known)
    return did_you_mean(word, known) or f"{introduction} {', '.join(known) or 'none'}"
