"""The exception for errors of the user: what is wrong, where, and what to do."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeVar

from mrpbench_core.files.printing import escaped, printable

Source = TypeVar("Source")
Content = TypeVar("Content")

LONGEST = 1000
"""Characters of the message of an exception from foreign code."""


class InputError(Exception):
    """An error in the user's input; printed as one line, never as a traceback.

    Attributes:
        message: what is wrong.
        file: the file that contains it, if any.
        line, column: counted from 1, where known.
        hint: what to do, e.g. `did you mean 'eecbs'?`.
    """

    def __init__(
        self,
        message: str,
        *,
        file: Path | str | None = None,
        line: int | None = None,
        column: int | None = None,
        hint: str | None = None,
    ) -> None:
        self.message = message
        self.file = None if file is None else Path(file)
        self.line = line
        self.column = column
        self.hint = hint
        super().__init__(str(self))

    def __str__(self) -> str:
        parts = [str(part) for part in (self.file, self.line, self.column) if part is not None]
        where = ":".join(parts) + ": " if parts else ""
        return escaped(where + self.message + (f" ({self.hint})" if self.hint else "")).replace("\n", r"\n")


class InputErrors(Exception):  # noqa: N818 - it is several of them
    """Several errors of the user that were found together.

    Attributes:
        errors: each of them.
    """

    def __init__(self, *errors: InputError) -> None:
        self.errors = list(errors)
        super().__init__("\n".join(str(error) for error in errors))


def in_reading_order(errors: Iterable[InputError]) -> list[InputError]:
    """Return each error once, by file, line and column; errors without a location come first."""
    once = {str(error): error for error in errors}
    return sorted(once.values(), key=lambda error: (str(error.file or ""), error.line or 0, error.column or 0))


def read_all(read: Callable[[Source], Content], sources: Iterable[Source]) -> list[Content]:
    """Return what `read` returns for each source.

    Raises:
        InputErrors: the errors of all sources together, each once.
    """
    contents, errors = [], []
    for source in sources:
        try:
            contents.append(read(source))
        except InputError as error:
            errors.append(error)
        except InputErrors as several:
            errors += several.errors
    if errors:
        raise InputErrors(*{str(error): error for error in errors}.values())
    return contents


def one_line(error: BaseException) -> str:
    """Return type and message of an exception from foreign code as one printable line, cut if it is very long."""
    try:
        text = str(error)[:LONGEST]
    except BaseException:  # noqa: BLE001 - which is foreign code, too
        text = ""
    return printable(f"{type(error).__name__}: {text}" if text.strip() else type(error).__name__)
