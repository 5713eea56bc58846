"""What a release promises: a small default set, equal versions, licences in every distribution, and a citation."""

import re
import runpy
import tomllib
from importlib import metadata, util
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

from mrpbench_core.plugins.installed import incompatibility

ROOT = Path(__file__).parents[1]
PROJECTS = [
    ROOT / "pyproject.toml",
    *(
        file
        for part in ("metapackage", "native", "plugins")
        for file in sorted((ROOT / part).glob("**/pyproject.toml"))
    ),
]
PINS = runpy.run_path(str(ROOT / "metapackage/hatch_build.py"))
MOST_BYTES, MOST_OTHERS = 100_000_000, 12


def project(file):
    return tomllib.loads(file.read_text())


def closure(names):
    """Names of distributions with all that they require here, without extras."""
    found, waiting = set(), [canonicalize_name(name) for name in names]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            needs = map(Requirement, metadata.requires(name) or ())
            waiting += [
                canonicalize_name(it.name) for it in needs if not it.marker or it.marker.evaluate({"extra": ""})
            ]
    return found


def size(name):
    """Bytes of the files of a distribution; ours are installed editable, so their packages are looked up."""
    total = sum(file.size or 0 for file in metadata.distribution(name).files)
    for package in OWN.get(name, ()):
        for folder in util.find_spec(package).submodule_search_locations:
            files = (file for file in Path(folder).rglob("*") if file.is_file())
            total += sum(file.stat().st_size for file in files if "__pycache__" not in file.parts)
    return total


def wheel_packages(file):
    return [Path(name).name for name in project(file)["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]]


OWN = {
    "mrpbench-core": ["mrpbench_core"],
    "mrpbench-native": ["mrpbench_native"],
    "mrpbench-standard": wheel_packages(ROOT / "plugins/pyproject.toml"),
    **{f"mrpbench-{name}": [f"mrpbench_{name}"] for name in ("analysis", "league", "publish", "replay")},
}


def test_the_default_set_is_small():
    """`make wheels` measures the same in empty environments."""
    names = closure(PINS["DEFAULT"]) | {"mrpbench"}
    others = {name for name in names if not name.startswith("mrpbench")}
    assert len(others) <= MOST_OTHERS, sorted(others)
    sizes = {name: size(name) for name in names - {"mrpbench"}}
    assert sum(sizes.values()) <= MOST_BYTES, sorted(sizes.items(), key=lambda item: -item[1])
    assert sizes["numpy"] > 10_000_000  # the measure measures
    assert min(sizes[name] for name in OWN) > 50_000


@pytest.mark.parametrize("file", PROJECTS, ids=lambda file: project(file)["project"]["name"])
def test_every_distribution_says_whose_it_is(file):
    facts, core = project(file)["project"], project(ROOT / "pyproject.toml")["project"]
    assert {key: facts[key] for key in ("license", "authors", "requires-python", "urls")} == {
        key: core[key] for key in ("license", "authors", "requires-python", "urls")
    }
    for name in facts["license-files"]:  # sdists cannot reach outside their folder
        assert (file.parent / name).read_bytes() == (ROOT / name).read_bytes()
    assert set(core["license-files"]) == set(facts["license-files"])
    assert {text for text in facts["classifiers"] if "Python :: 3" in text} == {
        text for text in core["classifiers"] if "Python :: 3" in text
    }
    assert (file.parent / facts["readme"]).is_file()


def test_all_distributions_take_one_version_from_the_tag():
    fallbacks = set()
    for file in PROJECTS:
        table = project(file)
        assert "version" in table["project"]["dynamic"]
        if file.parent.name == "native":
            scm = table["tool"]["setuptools_scm"]
            root, fallback = scm["root"], scm["fallback_version"]
        else:
            scm = table["tool"]["hatch"]["version"]
            root, fallback = scm.get("raw-options", {}).get("root", "."), scm["fallback-version"]
        assert (file.parent / root).resolve() == ROOT
        fallbacks.add(fallback)
    (released,) = fallbacks
    newest = re.search(r"^## \[(\d+\.\d+\.\d+)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert newest[1] == released


def test_plugins_need_the_core_of_their_minor_version():
    series = Version(metadata.version("mrpbench-core")).release
    wanted = f"mrpbench-core<{series[0]}.{series[1] + 1},>={series[0]}.{series[1]}"
    for file in (it for it in PROJECTS if "plugins" in it.parts):
        needs = [str(Requirement(text)) for text in project(file)["project"]["dependencies"]]
        assert wanted in needs
        assert incompatibility(needs) is None


@pytest.mark.parametrize(
    ("core", "works"),
    [("0.2.0", True), ("0.2.1.dev7+g1a2b3c4", True), ("0.2.9", True), ("0.3.0", False), ("0.3.0.dev1", False)],
)
def test_a_plugin_works_with_development_versions_between_releases(monkeypatch, core, works):
    monkeypatch.setattr(metadata, "version", lambda _: core)
    assert (incompatibility(["mrpbench-core>=0.2,<0.3"]) is None) is works


def test_the_citation_is_of_this_release():
    """`make wheels` validates the file with cffconvert."""
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert {"cff-version", "message", "title", "authors"} <= set(citation)  # what version 1.2.0 requires
    assert citation["license"] == project(ROOT / "pyproject.toml")["project"]["license"]
    assert f"## [{citation['version']}]" in (ROOT / "CHANGELOG.md").read_text()


def test_workflows_call_targets_that_exist():
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    called = set()
    for file in (ROOT / ".github/workflows").glob("*.yml"):
        jobs = yaml.safe_load(file.read_text())["jobs"].values()
        steps = [step.get("run", "") for job in jobs for step in job["steps"]]
        called |= {words[1] for words in map(str.split, steps) if words[:1] == ["make"]}
    assert {"test", "wheels"} <= called <= targets
