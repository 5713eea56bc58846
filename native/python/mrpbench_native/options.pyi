"""The options of components in C++."""

from typing import Literal

class Option:
    """An option of a component."""

    @property
    def name(self) -> str:
        """The word that sets it."""
    @property
    def type(self) -> Literal["bool", "int", "float", "str"]: ...
    @property
    def optional(self) -> bool:
        """It may be None."""
    @property
    def default(self) -> bool | int | float | str | None:
        """Its value unless it is set."""
    @property
    def least(self) -> float | None:
        """Of numbers, None if unbounded."""
    @property
    def above(self) -> bool:
        """`least` itself is excluded."""
    @property
    def most(self) -> float | None:
        """Of numbers, None if unbounded."""
    @property
    def usual(self) -> tuple[float, float] | None:
        """Of numbers, from where to where a search looks for better values; None if nothing is said."""
    @property
    def unit(self) -> str:
        """Of numbers, an empty text if none."""
    @property
    def choices(self) -> list[str]:
        """The words it may be; [] for other types."""
    @property
    def help(self) -> str:
        """One sentence, without a full stop."""
    @property
    def paper(self) -> str:
        """Short citation, or an empty text."""
    @property
    def fixed(self) -> bool:
        """The name of the component decides it; plugins do not offer it."""
