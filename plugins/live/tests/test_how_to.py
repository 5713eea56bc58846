"""The page docs/how-to/vda5050.md: its files and commands work, on a broker of the test."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("paho.mqtt", reason="mrpbench-live[vda5050] is not installed")
PAGE = Path(__file__).parents[3] / "docs" / "how-to" / "vda5050.md"
BIN = Path(sys.executable).parent


def test_the_page_works(tmp_path, broker):
    text = PAGE.read_text()
    for name, code in re.findall(r"as `([\w.]+)`:\n```\w+\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        (tmp_path / name).write_text(code)
    serve, control, check = (
        re.search(rf"^{start}.*$", text, re.MULTILINE)[0].replace("1883", str(broker.port)).split()
        for start in ("mrpbench serve", "python control.py", "mrpbench check-vda5050 vehicle")
    )
    said = re.search(r"```text\n(the vehicle .*)\n```", text)[1]
    served = subprocess.Popen([BIN / serve[0], *serve[1:]], cwd=tmp_path, stdout=subprocess.DEVNULL)
    try:
        done = subprocess.run(
            [BIN / control[0], *control[1:]], cwd=tmp_path, stdout=subprocess.PIPE, text=True, timeout=60, check=True
        )
        assert done.stdout.strip() == said
        checked = subprocess.run([BIN / check[0], *check[1:]], stdout=subprocess.PIPE, text=True, timeout=60)
        assert (checked.returncode, "broken" in checked.stdout) == (0, False), checked.stdout
    finally:
        served.kill()
        served.wait()
