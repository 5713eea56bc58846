"""The command `mrpbench`. Each command is a module, imported only when it is named.

A command's module has `configure(parser)`, which declares its arguments, and `run(arguments) -> int`, which returns the
exit code. Errors of the user are raised as `InputError` and printed here, one line each. Other distributions add
commands, see `mrpbench_core.cli.command`.
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
    "run": "do the runs of a study that have no record yet",
    "report": "print tables of results with intervals, and write an HTML page",
    "export": "write a stored run in another format",
    "scenario": "write the scenarios of a study to files, for publication",
    "plugins": "list installed plugins, or show the options of one",
    "check": "check a plugin against the contract of its kind",
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
    name = words[0] if words else "--help"
    if name.startswith("-"):
        top = Parser(
            prog="mrpbench",
            description="Benchmark for multi-robot planning, from task assignment to execution.",
            formatter_class=argparse.RawDescriptionHelpFormatter,
            usage="mrpbench [-h] [--version] COMMAND …",
        )
        top.add_argument("--version", action="version", version=f"mrpbench {__version__}")
        top.epilog = None if name == "--version" else _list_of_commands()
        top.parse_args(words)
        top.print_help()
        return 0 if words else 2
    if name in COMMANDS:
        summary, command = COMMANDS[name], importlib.import_module(f"mrpbench_core.cli.{name.replace('-', '_')}")
    else:
        from mrpbench_core.cli.command import find

        summary, command = find(name, COMMANDS)
    parser = Parser(prog=f"mrpbench {name}", description=f"{summary[:1].upper()}{summary[1:]}.")
    command.configure(parser)
    code: int = command.run(parser.parse_intermixed_args(words[1:]))
    return code


def _list_of_commands() -> str:
    from mrpbench_core.cli.command import summaries

    listed, unusable = dict(COMMANDS), ""
    for name, summary in summaries(COMMANDS):
        if isinstance(summary, InputError):
            unusable += f"\n{summary}"
        else:
            listed[name] = summary
    width = max(map(len, listed))
    lines = "".join(f"  {name:<{width}} {summary}\n" for name, summary in listed.items())
    return f"commands:\n{lines}\n`mrpbench COMMAND --help` describes a command.{unusable}"


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
