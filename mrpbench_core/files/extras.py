"""Libraries that a default installation leaves out, and the command that installs them."""

from importlib.util import find_spec


def has(module: str) -> bool:
    """True if a library is installed; it is not imported."""
    return find_spec(module) is not None


def pip(extra: str = "") -> str:
    """Return the command that installs the distribution `mrpbench` with an extra, for errors and notes."""
    return f"`pip install 'mrpbench[{extra}]'`" if extra else "`pip install mrpbench`"
