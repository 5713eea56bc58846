"""An honest bundle of a small study with executions, and a forger who keeps its hashes consistent."""

import json
import shutil
from pathlib import Path

import pytest
from mrpbench_publish.bundles.publish import PublishOptions, publish
from mrpbench_publish.bundles.verify import VerifyOptions, verify
from mrpbench_publish.files.archive import pack, unpack
from mrpbench_publish.files.bag import read_info, tag_files
from mrpbench_publish.files.description import read_description
from mrpbench_publish.files.layout import CITATION, CRATE, RESULTS, STUDY

from mrpbench_core import load, run
from mrpbench_core.engine.processes.slots import slots_of_this_process
from mrpbench_core.files.yaml import load as load_yaml
from mrpbench_core.store.invocation import write_document
from mrpbench_core.store.run_files import digest

MAP = "type octile\nheight 4\nwidth 6\nmap\n......\n..@...\n......\n......\n"
STUDY_FILE = """\
name: tiny
world: {plugin: movingai, file: maps/tiny.map}
roadmap: grid
scenario: {plugin: random, robots: 2}
assigner: identity
simulator: planar
metrics: [planning, execution]
matrix:
  planner: [cbs, prioritized]
  seed: 0..1
"""


PLANNER = """\
import os, time
import attrs
from mrpbench_core.api import Planner, option
from mrpbench_core.model.planning.plan import PlanResult, PlanStatus

@attrs.frozen(kw_only=True)
class Odd(Planner):
    does: str = option("nothing", help="what to do before it finds no plan")

    def plan(self, problem, budget):
        if self.does == "exit":
            os._exit(7)
        while self.does == "hang":
            time.sleep(1)
        if self.does == "system_exit":
            raise SystemExit("farewell")
        return PlanResult(status=PlanStatus.UNSOLVABLE)
"""


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A configuration with a planner of its own that misbehaves when asked to; its folder is the working directory."""
    (tmp_path / "odd.py").write_text(PLANNER)
    (tmp_path / "small.map").write_text(MAP)
    monkeypatch.chdir(tmp_path)
    return {
        "name": "odd",
        "world": {"plugin": "movingai", "file": "small.map"},
        "roadmap": "grid",
        "scenario": {"plugin": "random", "robots": 2},
        "assigner": "identity",
        "planner": {"plugin": "./odd.py:Odd"},
        "simulator": "none",
        "metrics": [],
        "limits": {"planning": 1.0, "wall": 30.0},
    }


@pytest.fixture(scope="package")
def honest(tmp_path_factory):
    """Return the folder with study, results and bundle `tiny.zip`."""
    folder = tmp_path_factory.mktemp("honest")
    (folder / "maps").mkdir()
    (folder / "maps" / "tiny.map").write_text(MAP)
    (folder / "tiny.yaml").write_text(STUDY_FILE)
    run(folder / "tiny.yaml", out=folder / "results")
    _bundle(folder / "results", folder / "tiny.zip", inputs=folder)
    return folder


def _bundle(results, out, **options):
    folders = results if isinstance(results, list) else [results]
    with slots_of_this_process() as slots:
        return publish([load(folder) for folder in folders], out, PublishOptions(**options), slots)


@pytest.fixture
def bundle():
    """Return a function that publishes a results folder, or several."""
    return _bundle


def _verdict(file, **options):
    with slots_of_this_process() as slots:
        return verify(file, VerifyOptions(**options), slots)


@pytest.fixture
def judged():
    """Return a function that verifies a bundle and gives the findings by check."""

    def judge(file, **options):
        return {it.name: it.findings for it in _verdict(file, **options).checks if it.outcome == "failed"}

    return judge


@pytest.fixture
def outcomes():
    """Return a function that verifies a bundle and gives the outcome of each check, and what it covered."""

    def judge(file, **options):
        return {it.name: (it.outcome, it.covered) for it in _verdict(file, **options).checks}

    return judge


class Reached(Exception):  # noqa: N818 - not an error
    """The check that a test asks for is done."""


@pytest.fixture
def found():
    """Return a function that verifies a bundle up to a check, and requires that this check names the forgery."""

    def require(file, check, words, **options):
        def said(done):
            if done.name == check:
                raise Reached(*done.findings)

        with slots_of_this_process() as slots, pytest.raises(Reached) as reached:
            verify(file, VerifyOptions(**options), slots, said)
        assert any(words in finding for finding in reached.value.args), reached.value.args

    return require


class Forger:
    """An unpacked bundle that is changed and packed again with consistent hashes."""

    def __init__(self, source, folder):
        unpack(source, folder)
        (self.top,) = folder.iterdir()
        self.results = self.top / RESULTS
        self.out = folder / "forged.zip"

    @property
    def shard(self):
        """Return the file of records."""
        return next((self.results / "runs").iterdir())

    @property
    def document(self):
        """Return the document of the invocation."""
        return self.results / "invocations" / f"{self.shard.stem}.yaml"

    def records(self):
        """Read all records."""
        return [json.loads(line) for line in self.shard.read_text().splitlines()]

    def write(self, records):
        """Write all records."""
        self.shard.write_text("".join(json.dumps(record, ensure_ascii=False) + "\n" for record in records))

    def edit(self, change, which=0):
        """Change one record."""
        records = self.records()
        change(records[which])
        self.write(records)

    def edit_all(self, change):
        """Change all records."""
        records = self.records()
        for record in records:
            change(record)
        self.write(records)

    def edit_document(self, change):
        """Change the document of the invocation."""
        data = load_yaml(self.document).data
        change(data)
        write_document(self.document, data)

    def recording(self, which=0):
        """Return the recording of a record."""
        return self.results / "recordings" / f"{self.records()[which]['run_id']}.zip"

    def sums(self):
        """Compute again what records say of their files."""

        def renewed(record):
            lines = []
            for line in record["provenance"]["files"]:
                name = line.partition("  ")[2]
                file = self.results / name
                lines.append(f"{digest(file)}  {name}" if file.is_file() else line)
            record["provenance"]["files"] = lines

        self.edit_all(renewed)

    def pack(self, *, seal=True):
        """Write the bundle; `seal` computes hashes and description again."""
        files = {str(file.relative_to(self.top)): file for file in self.top.rglob("*") if file.is_file()}
        payload = {name: file for name, file in files.items() if name.startswith("data/")}
        if seal:
            self.sums()
            documents = {file.stem: load_yaml(file).data for file in (self.results / "invocations").iterdir()}
            info = read_info(self.top)
            info.pop("Payload-Oxum")
            version = info["Bag-Software-Agent"].removeprefix("mrpbench ")
            description = read_description((self.top / CRATE).read_bytes())
            write_document(self.top / STUDY, documents[max(documents)]["study"])
            (self.top / CRATE).write_bytes(description.crate(payload, documents, version))
            (self.top / CITATION).write_bytes(description.citation(version))
            files = payload | tag_files(payload, info)
        pack(self.out, {f"{self.top.name}/{name}": part for name, part in files.items()})
        return self.out


@pytest.fixture
def forger(honest, tmp_path):
    """Return a forger of the honest bundle."""
    (tmp_path / "forged").mkdir()
    return Forger(honest / "tiny.zip", tmp_path / "forged")


@pytest.fixture
def copied(honest, tmp_path):
    """Return a copy of the folder of the honest study."""
    shutil.copytree(honest, tmp_path / "copy")
    return Path(tmp_path / "copy")
