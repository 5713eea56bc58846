"""Components by name: installed, local, broken, clashing."""

import importlib
import pickle
import subprocess
import sys

import pytest

from mrpbench_core.api import KINDS, Component, Planner
from mrpbench_core.files.errors import InputError
from mrpbench_core.plugins import installed, kinds
from mrpbench_core.plugins.registry import Registry

PLANNERS = Registry(Planner)

GOOD = """
import attrs
from mrpbench_core.api import Planner, option

@attrs.frozen(kw_only=True)
class Good(Planner):
    w: float = option(1.2, help="bound")
    def plan(self, problem, budget): ...
"""


def names(group="mrpbench.planners"):
    return [(entry.name, entry.distribution, entry.version) for entry in installed.providers(group)]


def test_the_light_table_of_kinds_is_that_of_the_contracts():
    assert {kind: cls.group for kind, cls in KINDS.items()} == kinds.GROUPS
    for kind, group in kinds.GROUPS.items():
        assert (kinds.kind_of(group), kinds.group_of(kind), kinds.group_of(f"{kind}s")) == (kind, group, group)


def test_an_installed_planner_is_found_and_imported_only_when_chosen(install):
    install("acme-mapf", {"mrpbench.planners": {"good": "{module}:Good"}}, GOOD, version="0.3.1")
    assert names() == [("good", "acme-mapf", "0.3.1")]
    assert "acme_mapf" not in sys.modules
    planner = PLANNERS.get("good")()
    assert planner.w == 1.2
    assert pickle.loads(pickle.dumps(planner)) == planner
    assert PLANNERS.name_of(type(planner)) == "good"


def test_an_uninstalled_planner_is_gone(install):
    module = install("acme-mapf", {"mrpbench.planners": {"good": "{module}:Good"}}, GOOD)
    assert names()
    (module.parent / "acme_mapf-1.0.dist-info" / "entry_points.txt").unlink()
    installed.refresh()
    assert names() == []
    with pytest.raises(InputError, match="no planner is called 'good'"):
        PLANNERS.get("good")


def test_an_unknown_name_suggests_the_nearest_and_says_where_the_list_is(install):
    install("acme-mapf", {"mrpbench.planners": {"acme_cbs": "{module}:Good", "other": "{module}:Good"}}, GOOD)
    with pytest.raises(InputError) as caught:
        PLANNERS.get("acme_cb")
    assert str(caught.value) == (
        "no planner is called 'acme_cb' (did you mean 'acme_cbs'? `mrpbench plugins` lists what is installed:"
        " acme_cbs, other)"
    )


def test_a_name_that_two_distributions_offer_must_be_chosen(install):
    for name in ("acme-good", "acme-clash"):
        install(name, {"mrpbench.planners": {"cbs": "{module}:Good"}}, GOOD)
    with pytest.raises(InputError) as caught:
        PLANNERS.get("cbs")
    assert str(caught.value) == (
        "planner 'cbs' is offered by acme-clash 1.0 and acme-good 1.0 (write cbs@acme-clash or cbs@acme-good)"
    )
    chosen = PLANNERS.get("cbs@acme_Good")
    assert chosen.__module__ == "acme_good"
    assert PLANNERS.name_of(chosen) == "cbs@acme-good"
    with pytest.raises(InputError, match="did you mean 'cbs@acme-good'"):
        PLANNERS.get("cbs@acme-god")


@pytest.mark.parametrize(
    ("code", "what"),
    [
        ("import no_such_module", "ModuleNotFoundError: No module named 'no_such_module'"),
        ("raise SystemExit('bye')", "SystemExit: bye"),
        ("raise RuntimeError('two\\nlines')", "RuntimeError: two lines"),
        ("Godo = 1", "AttributeError"),
        ("def (:", "SyntaxError"),
        ("raise BaseExceptionGroup('odd', [GeneratorExit()])", "BaseExceptionGroup: odd"),
    ],
)
def test_an_import_that_fails_names_distribution_version_and_cause(install, code, what):
    install("acme-broken", {"mrpbench.planners": {"bad": "{module}:Good"}}, code, version="0.3.1")
    install("acme-mapf", {"mrpbench.planners": {"good": "{module}:Good"}}, GOOD)
    with pytest.raises(InputError) as caught:
        PLANNERS.get("bad")
    assert str(caught.value).startswith(f"planner 'bad' of acme-broken 0.3.1 cannot be imported: {what}")
    assert "\n" not in str(caught.value)
    assert PLANNERS.get("good").__name__ == "Good"


@pytest.mark.parametrize(
    ("requirement", "refused"),
    [
        ("mrpbench-core>=2,<3", True),
        ("mrpbench_core (<0.0.1)", True),
        ("mrpbench-core>=0.0.1", False),
        ("mrpbench-core>=2; extra == 'future'", False),
        ("mrpbench-core>=2; python_version < '3'", False),
        ("not a requirement!!", False),
    ],
)
def test_a_plugin_for_another_core_is_refused_before_it_is_imported(install, requirement, refused):
    install("acme-future", {"mrpbench.planners": {"future": "{module}:Good"}}, GOOD, "9.0", [requirement])
    (provider,) = PLANNERS
    assert (provider.problem is not None) == refused
    if refused:
        with pytest.raises(InputError, match=r"planner 'future' of acme-future 9.0 needs mrpbench-core"):
            PLANNERS.get("future")
        assert "acme_future" not in sys.modules
    else:
        PLANNERS.get("future")


@pytest.mark.parametrize(
    ("body", "what"),
    [
        ("class Bad: ...", "is not a subclass of Planner"),
        ("def Bad(): ...", "is not a subclass of Planner"),
        ("Bad = 3", "is not a subclass of Planner"),
        ("@attrs.frozen(kw_only=True)\nclass Bad(Planner): ...", "lacks the methods plan"),
        ("class Bad(Planner):\n    def plan(self, problem, budget): ...", "is not decorated"),
        ("@attrs.define\nclass Bad(Planner):\n    def plan(self, problem, budget): ...", "is not decorated"),
        (
            "@attrs.define(slots=False)\nclass Bad(Planner):\n    def plan(self, problem, budget): ...",
            "is not decorated",
        ),
        ("class Bad(Good):\n    x: int = 3", "is not decorated"),
        (
            "@attrs.frozen(kw_only=True, auto_attribs=False)\nclass Bad(Planner):\n    w: float = 1.0\n    plan = None",
            "annotated public names that are not options: w",
        ),
        (
            "@attrs.frozen(kw_only=True)\nclass Bad(Planner):\n    x: 'Nowhere' = 1\n    plan = None",
            "type cannot be resolved: name 'Nowhere'",
        ),
        ("@attrs.frozen(kw_only=True)\nclass Bad(Good):\n    plugin: int = 1", "has an option called `plugin`"),
        (
            "@attrs.frozen(kw_only=True)\nclass Bad(Good):\n    __module__ = 'mrpbench_core.api.planner'",
            "says that it is of the module mrpbench_core.api.planner, where it is not",
        ),
        (
            """
class Meta(type(Planner)):
    def __hash__(cls):
        raise SystemExit("no")

@attrs.frozen(kw_only=True)
class Bad(Planner, metaclass=Meta):
    plan = None
""",
            "it cannot be examined: SystemExit: no",
        ),
        ("class Bad:\n    __class__ = property(lambda self: 1 / 0)\n\nBad = Bad()", "examined: ZeroDivisionError"),
    ],
)
def test_a_class_that_breaks_the_contract_says_how(install, body, what):
    install("acme-bad", {"mrpbench.planners": {"bad": "{module}:Bad"}}, GOOD + "\n" + body)
    with pytest.raises(InputError, match=what) as caught:
        PLANNERS.get("bad")
    assert str(caught.value).startswith("planner 'bad' of acme-bad 1.0: ")


def test_class_variables_and_private_names_are_no_stray_options(install):
    code = GOOD.replace("import attrs", "from __future__ import annotations\nimport attrs\nimport typing")
    code += "\n    kind: typing.ClassVar[int] = 3\n    other: 'typing.ClassVar[int]' = 3\n    _x: int = 4\n"
    install("acme-mapf", {"mrpbench.planners": {"good": "{module}:Good"}}, code)
    assert PLANNERS.get("good")(x=5).w == 1.2


def test_a_plugin_may_define_a_kind_of_its_own(install):
    code = """
    from typing import ClassVar
    import attrs
    from mrpbench_core.api import Component, option

    class Critic(Component):
        group: ClassVar[str] = "mrpbench.critics"

    @attrs.frozen(kw_only=True)
    class Obstacle(Critic):
        scale: float = option(1.0, help="weight")
    """
    install("acme-dwb", {"mrpbench.critics": {"obstacle": "{module}:Obstacle"}}, code)
    critic = importlib.import_module("acme_dwb").Critic
    assert Registry(critic).kind == "critic"
    assert Registry(critic).get("obstacle")().scale == 1.0
    assert [(entry.kind, entry.name) for entry in installed.installed()] == [("critic", "obstacle")]
    with pytest.raises(InputError, match="no critic is called 'obstacles'"):
        Registry(critic).get("obstacles")


def test_a_component_offered_under_a_shorter_path_keeps_its_name(install):
    site = install("acme-mapf", {"mrpbench.planners": {"good": "{module}:Alias"}}, GOOD + "\nAlias = Good\n")
    assert site.exists()
    assert PLANNERS.name_of(PLANNERS.get("good")) == "good"


def test_a_local_file_needs_no_packaging(tmp_path, install):
    (tmp_path / "mine.py").write_text(GOOD)
    planner = PLANNERS.get("./mine.py:Good", tmp_path)
    assert PLANNERS.get("mine.py:Good", tmp_path) is planner
    assert PLANNERS.name_of(planner, tmp_path) == "mine.py:Good"
    assert pickle.loads(pickle.dumps(planner(w=2.0))) == planner(w=2.0)
    (tmp_path / "mine.py").write_text(GOOD.replace("1.2", "1.3"))
    assert PLANNERS.get("mine.py:Good", tmp_path)().w == 1.3
    assert PLANNERS.get("mine.py:Good", tmp_path, {"mine.py": GOOD})().w == 1.2


@pytest.mark.parametrize(
    ("name", "text", "what"),
    [
        ("./mine.py:Good", None, "mine.py: no such file"),
        ("./mine.py:Godo", GOOD, "has no 'Godo'"),
        ("./mine.py:", GOOD, "does not name a class"),
        (":Good", GOOD, "does not name a class"),
        ("./mine.py:Good", "def (:\n", "mine.py:1:5: "),
        ("./mine.py:Good", "import no_such_module", "mine.py cannot be imported: ModuleNotFoundError"),
        ("./mine.py:Good", "class Good: ...", "is not a subclass of Planner"),
        ("no_such_package.planners:Good", None, "cannot be imported: ModuleNotFoundError"),
    ],
)
def test_a_local_component_that_cannot_be_used_says_why(tmp_path, install, name, text, what):
    if text is not None:
        (tmp_path / "mine.py").write_text(text)
    with pytest.raises(InputError) as caught:
        PLANNERS.get(name, tmp_path)
    assert what in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_class_of_any_module_can_be_named(install):
    install("acme-mapf", {}, GOOD)
    planner = PLANNERS.get("acme_mapf:Good")
    assert PLANNERS.name_of(planner) == "acme_mapf:Good"


def test_every_component_of_this_distribution_keeps_its_contract():
    for kind, base in KINDS.items():
        for provider in Registry(base):
            if provider.distribution == "mrpbench-core" and (module := _built(provider)):
                assert issubclass(Registry(base).get(provider.name), base), (kind, module)


def _built(provider):
    return importlib.util.find_spec(provider.value.partition(":")[0].rpartition(".")[0])


def test_listing_imports_neither_plugins_nor_numpy():
    code = (
        "import sys; from mrpbench_core.plugins.installed import installed; assert installed();"
        "assert not {'numpy', 'mrpbench_core.api', 'yaml', 'mrpbench_native'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_base_component_is_not_a_kind():
    assert not hasattr(Component, "group")
