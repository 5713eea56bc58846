"""The pages agree with the tree: links and paths exist, and the layers are those that import-linter checks."""

import re
import tomllib
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = sorted(
    file
    for pattern in ("*.md", "docs/**/*.md", "plugins/**/README.md", "native/README.md")
    for file in ROOT.glob(pattern)
)
CURRENT = [page for page in PAGES if page.name != "CHANGELOG.md"]
"""Pages that describe the tree as it is; the changelog names files as they were."""
LINK = re.compile(r"\]\((?!https?:|mailto:)([^)#\s]*)(?:#([^)\s]+))?\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
IN_TREE = re.compile(r"`((?:mrpbench_core|native|plugins|tests|docs|benchmarks|scripts|studies)/[\w./-]*[\w/])`")


def name(page):
    return str(page.relative_to(ROOT))


@cache
def anchors(page):
    """The anchors that GitHub gives to headings."""
    words = (re.sub(r"[^\w\- ]", "", heading.lower()) for heading in HEADING.findall(page.read_text()))
    return {heading.strip().replace(" ", "-") for heading in words}


@pytest.fixture(scope="module")
def project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())


def leads_somewhere(page, file, heading):
    target = (page.parent / file).resolve() if file else page
    return target.exists() and (not heading or heading in anchors(target))


def test_links_lead_to_files_and_headings():
    links = [(page, *link) for page in PAGES for link in LINK.findall(page.read_text())]
    assert len(links) > 100
    assert [f"{name(page)}: {file}#{it}" for page, file, it in links if not leads_somewhere(page, file, it)] == []


def test_paths_that_pages_name_exist():
    paths = [(page, path) for page in CURRENT for path in IN_TREE.findall(page.read_text())]
    assert len(paths) > 100
    assert [f"{name(page)}: {path}" for page, path in paths if not any(ROOT.glob(path))] == []


def test_decisions_are_numbered_without_holes():
    numbers = sorted(int(page.name[:4]) for page in (ROOT / "docs/adr").glob("0*.md"))
    assert numbers == list(range(1, len(numbers) + 1))


def test_the_design_page_has_the_layers_of_the_contract(project):
    block = (ROOT / "docs/explanation/design.md").read_text().partition("## Layers")[2].split("```")[1]
    said = [set(layer.split(", ")) for layer in block.strip().split(" → ")]
    (contract,) = (it for it in project["tool"]["importlinter"]["contracts"] if it["name"] == "Layers of the core")
    assert said == [set(layer.split(" | ")) for layer in contract["layers"]]


def test_the_contracts_know_every_package(project):
    packages = {file.parent.name for file in ROOT.glob("plugins/**/mrpbench_*/__init__.py")}
    assert set(project["tool"]["mypy"]["packages"]) == packages | {"mrpbench_core", "mrpbench_native"}
    linter = project["tool"]["importlinter"]
    assert set(linter["root_packages"]) == packages | {"mrpbench_core", "mrpbench_native"}
    rules = [it["source_modules"] for it in linter["contracts"] if it["type"] == "forbidden"]
    known = {name for modules in rules for name in modules if not name.startswith(("mrpbench_core", "mrpbench_native"))}
    assert known == packages
