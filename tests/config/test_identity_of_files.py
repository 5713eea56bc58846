"""What files that components read contribute to a run's identity, with the plugins that are installed."""

import pytest

from mrpbench_core.config.study import load_study


def test_an_image_counts_that_a_map_names(tmp_path):
    pytest.importorskip("PIL")
    image = tmp_path / "map.pgm"
    image.write_bytes(b"P5 2 1 255 \xfe\xfe")
    (tmp_path / "map.yaml").write_text("image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\n")
    (tmp_path / "run.yaml").write_text(
        "world: {plugin: ros_map, file: map.yaml}\nroadmap: grid\nscenario: {plugin: random, robots: 1}\n"
        "assigner: identity\nplanner: example\nsimulator: none\n"
    )

    def run_id():
        return load_study(tmp_path / "run.yaml").runs[0].run_id

    before = run_id()
    assert run_id() == before
    image.write_bytes(b"P5 2 1 255 \xfe\x00")
    assert run_id() != before
