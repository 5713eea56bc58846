"""The look of pictures: colours, sizes, fonts."""

from contextlib import AbstractContextManager

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.extras import pip

COLOURS = ("#332288", "#44aa99", "#882255", "#88ccee", "#117733", "#ddcc77", "#aa4499", "#999933")
"""Colours of robots that colour-blind readers can distinguish: Paul Tol, "Colour Schemes", SRON/EPS/TN/09-002, 2021."""
WALL, LANE, ROAD, NAME, DOOR, LIFT = "#3b4252", "#9db4c8", "#e8f0f6", "#51606e", "#b07d2b", "#7a5195"
PERSON = "#8a8f98"
"""Of people and other movers, which no robot has."""
PIXELS = 1280
"""Width of a picture, or height of a tall one."""
DPI = 160


def own_style() -> AbstractContextManager[None]:
    """Return a context in which matplotlib has the style of these pictures, whatever the user's settings.

    Raises:
        InputError: matplotlib is not installed.
    """
    try:
        import matplotlib
    except ImportError:
        raise InputError("pictures need matplotlib", hint=pip("figures")) from None
    style: AbstractContextManager[None] = matplotlib.rc_context(
        {"font.family": "sans-serif", "font.size": 7, "text.parse_math": False}
    )
    return style
