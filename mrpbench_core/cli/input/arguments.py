"""Arguments that several commands share."""

import argparse
import re
from collections.abc import Sequence
from typing import Any

from mrpbench_core.files.errors import InputError
from mrpbench_core.files.yaml import loads

_OVERRIDE = re.compile(r"[A-Za-z_][\w.,\- ]*=")
_PATTERN = re.compile(r"""(?<![^\s,\[])[^\s,\[\]'"]*\{[A-Za-z_]\w*\}[^\s,\[\]'"]*(?![^\s,\]])""")
"""Text with a placeholder, such as `/{robot}/odom`, without quotes. YAML reads its braces as a mapping."""


def add_configuration(parser: argparse.ArgumentParser) -> None:
    """Declare `CONFIG… [key=value…]`, in any order among the options."""
    parser.add_argument(
        "words",
        nargs="+",
        metavar="CONFIG… [KEY=VALUE…]",
        help="configuration files, and dotted options that override them, e.g. planner.w=1.5 seed=0..9",
    )


def add_executor(parser: argparse.ArgumentParser) -> None:
    """Declare what does the runs, and how many at a time."""
    parser.add_argument("--workers", type=int, default=1, metavar="N", help="number of runs at a time (default: 1)")
    parser.add_argument(
        "--executor", default="processes", metavar="NAME", help="executor of the runs (default: %(default)s)"
    )
    parser.add_argument("--executor-option", action="append", default=[], metavar="K=V", help="option of the executor")


def split_words(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """Return the files and the overrides."""
    overrides = [word for word in words if _OVERRIDE.match(word)]
    files = [word for word in words if not _OVERRIDE.match(word)]
    if not files:
        raise InputError("no configuration file is given", hint="`mrpbench init` writes one")
    return files, overrides


def split_names(words: str | None) -> list[str] | None:
    """Return names that are separated by commas; None stays None."""
    return None if words is None else [word.strip() for word in words.split(",") if word.strip()]


def read_options(words: Sequence[str], what: str) -> dict[str, Any]:
    """Return `KEY=VALUE` words as options; values are YAML, in which `/{robot}/odom` needs no quotes."""
    options = {}
    for word in words:
        key, equals, text = word.partition("=")
        if not equals or not key.isidentifier():
            raise InputError(f"{what} {word}: expected KEY=VALUE")
        options[key] = loads(_PATTERN.sub(lambda match: f'"{match[0]}"', text) or '""').data
    return options
