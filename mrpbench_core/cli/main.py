"""The command `mrpbench`. Each command is a module of this package, imported only when it is named.

A command's module has `configure(parser)`, which declares its arguments, and `run(arguments) -> int`, which returns the
exit code. Errors of the user are raised as `InputError` and printed here, one line each.
"""

import argparse
import importlib
import logging
import os
import sys
import tempfile
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

from mrpbench_core.cli.output.terminal import escaped_output
from mrpbench_core.files.disk import is_full
from mrpbench_core.files.errors import InputError, InputErrors
from mrpbench_core.files.platforms import require_posix
from mrpbench_core.version import __version__

COMMANDS = {
    "demo": "run a small office scenario, end to end, in under a minute",
    "init": "write a commented configuration that runs",
    "run": "do the runs of a study that have no record yet",
    "report": "print tables of results with intervals, and write an HTML page",
    "compare": "compare two results folders and test the differences",
    "calibrate": "fit the durations of a roadmap to how a controller drives",
    "saturate": "find the rate of tasks that the fleets of a study can serve",
    "view": "write a replay of a run as an HTML page",
    "export": "write a stored run in another format",
    "analyze": "compute metrics of a bag from a real fleet or another simulator",
    "publish": "write results as a bundle that others can verify",
    "verify": "check published results, and repeat a sample of their runs",
    "site": "make a static site of published results, with ranks",
    "scenario": "write the scenarios of a study to files, for publication",
    "world": "print the facts and faults of a map, draw it, convert it",
    "plugins": "list installed plugins, or show the options of one",
    "check": "check a plugin against the contract of its kind",
    "new-plugin": "write a working plugin to start from",
    "schema": "print the JSON Schema of configurations, for editors",
    "completion": "print a script with which shells complete commands and options",
    "info": "print facts about machine and installation, for bug reports",
}
INTERRUPTED = 130


class Parser(argparse.ArgumentParser):
    """Prints an error as one line."""

    def error(self, message: str) -> NoReturn:
        """Print the line and exit."""
        sys.stderr.write(f"{self.prog}: {message} (see `{self.prog} --help`)\n")
        raise SystemExit(2)


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code."""
    with escaped_output():
        return _main(list(sys.argv[1:] if argv is None else argv))


def _main(words: list[str]) -> int:
    logging.basicConfig(format="%(message)s", level=logging.WARNING)
    try:
        require_posix()
        code = _dispatch(words)
        sys.stdout.flush()
    except InputErrors as several:
        code = _input_errors(several.errors)
    except InputError as error:
        code = _input_errors([error])
    except KeyboardInterrupt:
        sys.stderr.write("mrpbench: interrupted\n")
        code = INTERRUPTED
    except BrokenPipeError:  # e.g. `| head` has ended; Python must not flush to it at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 0
    except OSError as error:
        if is_full(error):  # stdout, or a file that was being written
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            code = _input_errors([InputError(f"cannot write: {error.strerror}", file=error.filename)])
        elif isinstance(error.filename, str) and not os.environ.get("MRPBENCH_TRACEBACK"):
            code = _input_errors([InputError(error.strerror or "cannot be used", file=error.filename)])
        else:
            code = _defect(error)
    except Exception as error:  # noqa: BLE001 - the last resort: one line, and the rest where it can be found
        code = _defect(error)
    return code


def _dispatch(words: list[str]) -> int:
    top = Parser(
        prog="mrpbench",
        description="Benchmark for multi-robot planning, from task assignment to execution.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="commands:\n"
        + "\n".join(f"  {name:<10} {text}" for name, text in COMMANDS.items())
        + "\n\n`mrpbench COMMAND --help` describes a command.",
        usage="mrpbench [-h] [--version] COMMAND …",
    )
    top.add_argument("--version", action="version", version=f"mrpbench {__version__}")
    if not words or words[0].startswith("-"):
        top.parse_args(words)
        top.print_help()
        return 0 if words else 2
    name = words[0]
    if name not in COMMANDS:
        from mrpbench_core.files.suggestions import did_you_mean

        raise InputError(f"no command is called {name!r}", hint=did_you_mean(name, COMMANDS, "see --help"))
    command = importlib.import_module(f"mrpbench_core.cli.{name.replace('-', '_')}")
    parser = Parser(prog=f"mrpbench {name}", description=COMMANDS[name][0].upper() + COMMANDS[name][1:] + ".")
    command.configure(parser)
    code: int = command.run(parser.parse_intermixed_args(words[1:]))
    return code


def _input_errors(errors: Sequence[InputError]) -> int:
    for line in dict.fromkeys(str(error) for error in errors):
        sys.stderr.write(f"{line}\n")
    return 2


def _defect(error: Exception) -> int:
    """Report a defect of mrpbench in one line."""
    if os.environ.get("MRPBENCH_TRACEBACK"):
        traceback.print_exception(error)
        return 1
    with tempfile.NamedTemporaryFile("w", prefix="mrpbench-", suffix=".txt", delete=False) as log:
        traceback.print_exception(error, file=log)
    what = " ".join(f"{type(error).__name__}: {error}".split())[:200]
    sys.stderr.write(f"mrpbench: internal error: {what} (details in {Path(log.name)}; please report it)\n")
    return 1


if __name__ == "__main__":
    sys.exit(main())
