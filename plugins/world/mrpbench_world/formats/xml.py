"""Numbers and colours in the files of SDF and MJCF."""


def numbers(*values: float) -> str:
    """Numbers with nine digits, separated by spaces."""
    return " ".join(f"{float(value):.9g}" for value in values)


def opaque(colour: tuple[float, float, float]) -> str:
    """A colour as red, green, blue and alpha."""
    return numbers(*colour, 1)
