"""Collects every mistake of a configuration, instead of stopping at the first."""

import difflib
from collections.abc import Iterable

from mrpbench_core.files.errors import InputError


class Mistakes(Exception):  # noqa: N818 - it is several of them
    """What is wrong with one value and all values inside it."""

    def __init__(self, *errors: InputError) -> None:
        self.errors = errors
        super().__init__(*errors)


def in_reading_order(errors: Iterable[InputError]) -> list[InputError]:
    """Each error once, by file, line and column; those without a place first."""
    once = {str(error): error for error in errors}
    return sorted(once.values(), key=lambda error: (str(error.file or ""), error.line or 0, error.column or 0))


def did_you_mean(word: str, known: Iterable[str], introduction: str = "there are") -> str:
    """A hint: the nearest of the known words, or all of them."""
    known = list(known)
    if close := difflib.get_close_matches(word, known, n=1):
        return f"did you mean {close[0]!r}?"
    return f"{introduction} {', '.join(known)}" if known else f"{introduction} none"
