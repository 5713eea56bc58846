"""The provenance of components."""

import hashlib
import json
import subprocess

import attrs
import pytest

from mrpbench_core.api import Planner
from mrpbench_core.plugins.checkout import version_of
from mrpbench_core.plugins.provenance import provenance
from mrpbench_core.plugins.registry import Registry

CODE = """
from typing import ClassVar
import attrs
from mrpbench_core.api import Component, Planner, option

class Critic(Component):
    group: ClassVar[str] = "mrpbench.critics"

@attrs.frozen(kw_only=True)
class Obstacle(Critic):
    scale: float = option(1.0, help="weight")

@attrs.frozen(kw_only=True)
class Good(Planner):
    critics: tuple[Critic, ...] = option((), help="critics")
    def plan(self, problem, budget): ...
"""
NAMES = {"mrpbench.planners": {"good": "{module}:Good"}, "mrpbench.critics": {"obstacle": "{module}:Obstacle"}}


@attrs.frozen
class Holder:
    planners: dict
    seed: int = 0


def test_each_class_used_is_listed_once_with_its_distribution(install):
    url = {"url": "file:///home/me/acme", "dir_info": {"editable": True}}
    install("acme-mapf", NAMES, CODE, version="0.3.1", files={"direct_url.json": json.dumps(url)})
    good = Registry(Planner).get("good")
    import acme_mapf

    obstacle = acme_mapf.Obstacle
    value = Holder({"a": good(critics=(obstacle(scale=1), obstacle(scale=2))), "b": good()})
    origin = {"distribution": "acme-mapf", "version": "0.3.1", "direct_url": url}
    assert provenance(value) == [
        {"kind": "planner", "name": "good", **origin},
        {"kind": "critic", "name": "obstacle", **origin},
    ]


def test_a_release_has_no_direct_url(install):
    install("acme-other", NAMES, CODE)
    (found,) = provenance(Registry(Planner).get("good")())
    assert "direct_url" not in found


def test_a_local_component_is_listed_with_file_and_hash(tmp_path, install):
    (tmp_path / "mine.py").write_text(CODE)
    assert provenance(Registry(Planner).get("./mine.py:Good", tmp_path)(), tmp_path) == [
        {
            "kind": "planner",
            "name": "mine.py:Good",
            "file": "mine.py",
            "sha256": hashlib.sha256(CODE.encode()).hexdigest(),
        }
    ]


def test_a_class_named_by_its_module_is_listed_with_the_modules_hash(install):
    install("acme-plain", {}, CODE)
    assert provenance(Registry(Planner).get("acme_plain:Good")()) == [
        {
            "kind": "planner",
            "name": "acme_plain:Good",
            "file": "acme_plain.py",
            "sha256": hashlib.sha256(CODE.encode()).hexdigest(),
        }
    ]


def checkout(folder):
    """A repository with one commit; returns the commit."""
    git = ["git", "-C", str(folder), "-c", "user.name=me", "-c", "user.email=me@example.org"]
    (folder / "mine.py").write_text("")
    for words in (["init", "-q"], ["add", "mine.py"], ["commit", "-qm", "first"]):
        subprocess.run([*git, *words], check=True)
    return subprocess.run([*git, "rev-parse", "HEAD"], check=True, capture_output=True, text=True).stdout[:12]


@pytest.mark.parametrize(
    ("version", "expected"),
    [("1.0", "1.0+g{}"), ("0.2.1.dev7+g012345678", "0.2.1.dev0+g{}"), ("0.3rc1", "0.3rc1+g{}"), ("odd", "odd")],
)
def test_an_editable_installation_has_the_version_of_its_checkout(install, tmp_path, version, expected):
    folder = tmp_path / "checkout"
    folder.mkdir()
    commit = checkout(folder)
    url = json.dumps({"url": folder.as_uri(), "dir_info": {"editable": True}})
    name = f"acme-{len(version)}"
    pure = {"direct_url.json": url, "WHEEL": "Root-Is-Purelib: true\n"}
    install(name, {}, version=version, files=pure)
    assert version_of(name) == expected.format(commit)
    install(f"{name}-compiled", {}, version=version, files=pure | {"WHEEL": "Root-Is-Purelib: false\n"})
    assert version_of(f"{name}-compiled") == version


def test_changed_files_of_a_checkout_make_another_version(install, tmp_path):
    folder = tmp_path / "checkout"
    folder.mkdir()
    commit = checkout(folder)
    (folder / "mine.py").write_text("changed = True")
    url = json.dumps({"url": folder.as_uri(), "dir_info": {"editable": True}})
    install("acme-changed", {}, files={"direct_url.json": url, "WHEEL": "Root-Is-Purelib: true\n"})
    assert version_of("acme-changed") == f"1.0+g{commit}.dirty"
