"""A share of recordings or runs on the command line."""

from mrpbench_core.files.errors import InputError


def read_share(text: str, what: str) -> float:
    """Read a share: `all`, `none`, `10%` or `0.1`.

    Raises:
        InputError: it is none.
    """
    words = {"all": 1.0, "none": 0.0}
    number, percent, rest = text.partition("%")
    try:
        share = words[text] if text in words else float(number) / (100 if percent else 1)
    except ValueError:
        share = -1.0
    if rest or not 0 <= share <= 1:
        raise InputError(f"{what} {text}: expected `all`, `none` or a share such as 10%")
    return share
