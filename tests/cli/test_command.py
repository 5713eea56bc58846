"""Commands that other distributions add."""

import re
import subprocess
import sys
from importlib import metadata

import pytest

from mrpbench_core.cli import main

GROUP = "mrpbench.commands"
CODE = """
from mrpbench_core.cli.command import Command

COMMAND = Command("greet a robot", "{module}")
NOWHERE = Command("do nothing", "nowhere_at_all")

def configure(parser):
    parser.add_argument("name")

def run(arguments):
    print("hello", arguments.name)
    return 7
"""
HELP = "import sys; from mrpbench_core.cli.main import main; main(['--help'])"


@pytest.fixture
def greet(install):
    """A distribution with the command `greet` and one whose code does not exist."""
    names = {"greet": "{module}:COMMAND", "nowhere": "{module}:NOWHERE"}
    install("greeting", {GROUP: names}, CODE.format(module="greeting"))


@pytest.mark.usefixtures("greet")
def test_a_command_of_a_distribution_is_listed_and_run(mrpbench):
    assert re.search(r"\n  greet +greet a robot\n", mrpbench("--help")[1])
    assert mrpbench("greet", "r1") == (7, "hello r1\n", "")
    assert "Greet a robot." in mrpbench("greet", "--help")[1]
    assert "'gret' (did you mean 'greet'?)" in mrpbench("gret")[2]


@pytest.mark.usefixtures("greet")
def test_a_distribution_that_only_adds_commands_is_a_fact_of_the_installation(mrpbench):
    assert "greeting" in mrpbench("info")[1]
    assert "greet" not in mrpbench("plugins")[1]


@pytest.mark.usefixtures("greet")
@pytest.mark.parametrize(
    ("name", "code", "requires", "said"),
    [
        (
            "broken",
            "1 / 0",
            (),
            "command 'broken' of other 2.0 cannot be imported: ZeroDivisionError: division by",
        ),
        ("broken", "COMMAND = 'x'", (), "command 'broken' of other 2.0: other:COMMAND is not a mrpbench_core.cli"),
        (
            "broken",
            "",
            (),
            "command 'broken' of other 2.0 cannot be imported: AttributeError: module 'other' has no",
        ),
        ("broken", "raise SystemExit", (), "command 'broken' of other 2.0 cannot be imported: SystemExit"),
        ("greet", "", (), "command 'greet' is offered by greeting 1.0 and other 2.0 (uninstall one of them)"),
    ],
)
def test_a_command_that_cannot_be_used_is_one_line(mrpbench, install, name, code, requires, said):
    install("other", {GROUP: {name: "{module}:COMMAND"}}, code, version="2.0", requires=requires)
    exit_code, output, errors = mrpbench("--help")
    assert (exit_code, errors) == (0, "")
    assert [line for line in output.splitlines() if line.startswith(said)]
    assert set(main.COMMANDS) | {"nowhere"} < {line.split()[0] for line in output.splitlines() if line[:2] == "  "}
    exit_code, output, errors = mrpbench(name, "r1")
    assert (exit_code, output, errors.count("\n")) == (2, "", 1)
    assert errors.startswith(said)


@pytest.mark.usefixtures("greet")
def test_a_command_whose_code_does_not_exist_is_one_line(mrpbench):
    code, _, errors = mrpbench("nowhere")
    said = (
        "command 'nowhere' of greeting 1.0 cannot be imported: ModuleNotFoundError: No module named 'nowhere_at_all'\n"
    )
    assert (code, errors) == (2, said)


def test_no_distribution_replaces_a_command_of_the_core(mrpbench, install):
    install("thief", {GROUP: {"plugins": "{module}:COMMAND"}}, CODE.format(module="thief"))
    assert mrpbench("plugins", "--json") == (0, "[]\n", "")
    output = mrpbench("--help")[1]
    assert main.COMMANDS["plugins"] in output
    assert "greet a robot" not in output
    assert "\ncommand 'plugins' of thief 1.0 is not used: mrpbench-core has a command of this name\n" in output


@pytest.mark.parametrize("name", ["publish", "verify", "site", "analyze", "choose", "hunt"])
def test_a_command_of_a_distribution_that_is_not_installed_names_it(mrpbench, monkeypatch, name):
    monkeypatch.setattr(metadata, "entry_points", lambda **_: ())
    owners = {"analyze": "analysis", "choose": "search", "hunt": "search"}
    owner = f"mrpbench-{owners.get(name, 'publish')}"
    package = "'mrpbench[search]'" if owner == "mrpbench-search" else "mrpbench"
    said = f"no command is called {name!r} ({owner} has it: `pip install {package}`)\n"
    assert mrpbench(name, "x") == (2, "", said)
    assert f"\n  {name} " not in mrpbench("--help")[1]


def test_help_and_the_module_of_commands_do_not_import_numpy():
    code = f"{HELP}; import mrpbench_core.cli.command; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], stdout=subprocess.DEVNULL).returncode == 0


def test_a_command_of_a_distribution_for_another_core_is_not_run(mrpbench, install):
    code = CODE.format(module="new")
    install("new", {GROUP: {"greet": "{module}:COMMAND"}}, code, requires=["mrpbench-core>=99"])
    code, output, errors = mrpbench("greet", "r1")
    assert (code, output) == (2, "")
    assert errors.startswith("command 'greet' of new 1.0 needs mrpbench-core>=99, this is ")
