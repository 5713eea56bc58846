"""Do what a page says, in the current folder: `python reader.py PAGE`. The first thing that does not work ends it."""

import doctest
import subprocess
import sys
from pathlib import Path

import yaml
from blocks import Block, blocks_of

from mrpbench_core.config.study import load_study

ELLIPSIS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
STUDY = {"world": "office", "planner": "cbs", "scenario": {"plugin": "random", "robots": 3}}
"""What a part of a configuration is a part of, where it does not say otherwise."""


class Reader:
    """Reads one page from top to bottom."""

    def __init__(self, page: Path) -> None:
        self.page = page
        self.names: dict[str, object] = {"__name__": "page"}
        self.output: str | None = None
        """Output of the block before, if that was one of `sh`."""

    def read(self) -> None:
        """Do what the page says."""
        for block in blocks_of(self.page):
            print(f"{self.page.name}:{block.line}", flush=True)
            if block.reason:
                continue
            if block.file:
                file = Path(block.file)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(block.code)
                continue
            output, self.output = self.output, None
            if block.language in ("sh", "bash"):
                self.output = run(block.code)
            elif block.language == "python":
                # blank lines, so that errors name lines of the page
                exec(compile("\n" * (block.line - 1) + block.code, self.page, "exec"), self.names)
            elif block.language == "yaml":
                load(block)
            elif block.language not in ("", "text"):
                raise AssertionError(f"a block of {block.language} needs the name of its file, or a reason")
            elif output is not None:
                same = doctest.OutputChecker().check_output(block.code, output, ELLIPSIS)
                assert same, f"the page says\n{block.code}\nbut this is\n{output}"


def run(commands: str) -> str:
    """The output of commands, which must succeed."""
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], capture_output=True, text=True)
    print(done.stdout, done.stderr, sep="\n", flush=True)
    assert done.returncode == 0, f"exit status {done.returncode}: {commands}"
    return done.stdout


def load(block: Block) -> None:
    """Load a part of a configuration. A key that comes again begins another way to write the part."""
    parts: list[dict[str, object]] = [{}]
    node = yaml.compose(block.code, yaml.SafeLoader)
    for key, value in node.value:
        if key.value in parts[-1]:
            parts.append({})
        loader = yaml.SafeLoader("")
        parts[-1][key.value] = loader.construct_object(value, deep=True)
    for part in parts:
        file = Path("part.yaml")
        file.write_text(yaml.safe_dump(STUDY | part))
        study = load_study(file)
        assert not study.errors, "\n".join(map(str, study.errors))


if __name__ == "__main__":
    Reader(Path(sys.argv[1])).read()
