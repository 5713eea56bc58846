"""The page docs/how-to/rmf-traffic.md: its files and commands work, in a domain of the test."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds", reason="mrpbench-live[rmf] is not installed")
PAGE = Path(__file__).parents[4] / "docs" / "how-to" / "rmf-traffic.md"
BIN = Path(sys.executable).parent


def test_the_page_works(tmp_path, domain):
    text = PAGE.read_text()
    for name, code in re.findall(r"as `([\w.]+)`:\n```\w+\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        (tmp_path / name).write_text(code.replace("domain: 21", f"domain: {domain}").replace("pace: 4", "pace: 12"))
    commands = re.search(r"```sh\n(export .*?)```\n```text\n(.*?)```", text, re.DOTALL)
    script = commands[1].replace("send.py 21", f"send.py {domain}")
    script = script.replace("mrpbench", f"{BIN}/mrpbench").replace("python", sys.executable)
    done = subprocess.run(
        ["bash", "-ec", script], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120
    )
    assert done.returncode == 0, done.stdout
    assert commands[2] in done.stdout
    assert done.stdout.count("1 run: 1 succeeded") == 2, done.stdout
