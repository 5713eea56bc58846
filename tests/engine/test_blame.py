"""Failures name the plugin and the distribution that they are of."""

import pytest

from mrpbench_core.api.contract import BrokenContractError
from mrpbench_core.config.study import load_study
from mrpbench_core.engine.blame import broken, owner_of
from mrpbench_core.engine.processes.worker import describe
from mrpbench_core.plugins.provenance import title

STUDY = {"world": "office", "scenario": {"plugin": "random", "robots": 2}, "planner": "example"}
MINE = """
import attrs
from mrpbench_core.builtin.assigners.identity import Identity

@attrs.frozen(kw_only=True)
class Mine(Identity):
    def assign(self, problem):
        return helper(problem)

def helper(problem):
    raise ValueError("no idea")
"""


@pytest.fixture
def config():
    return load_study(STUDY).runs[0].config


def test_a_broken_contract_names_name_and_distribution(config):
    said = "the localizer returned NoneType instead of Estimate"
    assert broken(BrokenContractError(said, "localizer"), config).startswith(
        f"{said} (localizer 'ground_truth' of mrpbench-core "
    )
    assert "(planner 'example' of mrpbench-standard " in broken(BrokenContractError("x", "planner"), config)


def test_a_message_about_no_component_stays_as_it_is(config):
    assert broken(BrokenContractError("the disk is full"), config) == "the disk is full"
    assert broken(BrokenContractError("a crowd returned x", "crowds"), config) == "a crowd returned x"  # there is none
    assert broken(BrokenContractError("x", "planner"), None) == "x"


def test_an_exception_belongs_to_the_component_whose_code_raised_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.py").write_text(MINE)
    config = load_study(STUDY | {"assigner": "./mine.py:Mine"}).runs[0].config
    with pytest.raises(ValueError, match="no idea") as raised:
        config.assigner.assign(None)
    assert owner_of(raised.value, config) is config.assigner
    line = describe(raised.value, config)
    assert line.startswith("ValueError: no idea (mine.py:11), in the assigner 'mine.py:Mine'")


def test_an_exception_of_the_core_belongs_to_nothing(config):
    with pytest.raises(StopIteration) as raised:
        title(3)
    assert owner_of(raised.value, config) is None


def test_a_component_of_a_distribution_is_titled_with_its_version(config):
    assert title(config.planner).startswith("planner 'example' of mrpbench-standard ")
