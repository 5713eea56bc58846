"""`mrpbench completion`: print a script with which bash and zsh complete commands, options and their values."""

import argparse
import importlib
from collections.abc import Iterable
from shlex import quote

from mrpbench_core.cli.command import find, summaries
from mrpbench_core.cli.main import COMMANDS
from mrpbench_core.files.errors import InputError

_SCRIPT = """\
# Completion of mrpbench for bash; zsh needs `autoload -U +X bashcompinit && bashcompinit` before it.
_mrpbench() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} words=
    if [ "$COMP_CWORD" = 1 ]; then
        words={commands}
    else
        case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}} $word" in
{cases}
        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _mrpbench mrpbench
"""
"""Where there are no words, `-o default` completes names of files."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.epilog = (
        "To switch it on in bash: `mkdir -p ~/.local/share/bash-completion/completions`, then `mrpbench completion >"
        " ~/.local/share/bash-completion/completions/mrpbench`, and begin a new shell. For zsh, source the file in"
        " ~/.zshrc."
    )


def run(_: argparse.Namespace) -> int:
    """Print the script."""
    modules = {name: importlib.import_module(f"mrpbench_core.cli.{name.replace('-', '_')}") for name in COMMANDS}
    for name, summary in summaries(COMMANDS):
        if not isinstance(summary, InputError):
            modules[name] = find(name, COMMANDS)[1]
    cases = []
    for command, module in modules.items():
        parser = argparse.ArgumentParser(prog=command)
        module.configure(parser)
        actions = parser._actions
        options = [action for action in actions if action.option_strings]
        chosen = [action for action in options if action.choices]
        cases += [_case(f"{command} {one.option_strings[-1]} ", map(str, one.choices or ())) for one in chosen]
        cases.append(_case(f"{command} ", (action.option_strings[-1] for action in options), "*' -'*"))
    print(_SCRIPT.format(commands=quote(" ".join(modules)), cases="\n".join(cases)), end="")
    return 0


def _case(words_before: str, offered: Iterable[str], end: str = "*") -> str:
    return f"        {quote(words_before)}{end}) words={quote(' '.join(offered))} ;;"
