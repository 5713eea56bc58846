"""mrpbench: a benchmark for multi-robot planning, from task assignment to what the robots then do.

`run(config, *overrides)` does what a configuration describes and returns its results; `load(folder)` reads results.
"""

from typing import TYPE_CHECKING, Any

from mrpbench_core.version import __version__

__all__ = ["__version__", "load", "run"]

if TYPE_CHECKING:
    from mrpbench_core.engine.study.invoke import run as run
    from mrpbench_core.store.results import load as load


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def __getattr__(name: str) -> Any:
    """Import the two functions when they are used: plugins and `mrpbench --help` need only the version."""
    if name in __all__:
        from mrpbench_core.files.platforms import require_posix

        require_posix()
    if name == "run":
        from mrpbench_core.engine.study.invoke import run

        return run
    if name == "load":
        from mrpbench_core.store.results import load

        return load
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
