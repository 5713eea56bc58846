"""A frozen scenario is the same scenario."""

from mrpbench_core.builtin.scenarios.file import FromFile
from mrpbench_core.files.scenario import write_scenario


def test_a_frozen_scenario_pairs_with_the_run_it_was_taken_from(tmp_path, run_context):
    path = tmp_path / "frozen.yaml"
    write_scenario(path, run_context.scenario)
    source = FromFile(file=path)
    drawn = source.draw(run_context.world, run_context.problem.roadmap, run_context.fleet, 99)
    assert source.size() == 2
    assert drawn == run_context.scenario
    assert drawn.id == run_context.scenario.id
