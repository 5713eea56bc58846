import math

import numpy as np
import pytest
from mrpbench_worlds_standard.building.footprints import SHIPPED, Footprints

from mrpbench_core.files.errors import InputError

ROOM = """\
coordinate_system: cartesian_meters
levels:
  L1:
    vertices: [[0, 0, 0, a], [10, 0, 0, b]]
    lanes: [[0, 1, {}]]
    models: [%s]
"""


def model(name, x, y, **more):
    values = {"model_name": name, "name": "thing", "x": x, "y": y, "z": 0, "yaw": 0, "static": "true", **more}
    return "{" + ", ".join(f"{key}: {value}" for key, value in values.items()) + "}"


def obstacles(load, *models, **options):
    return load(ROOM % ", ".join(models), **options).levels[0].obstacles


def test_a_model_becomes_its_estimated_footprint_in_place(load):
    (desk,) = obstacles(load, model("OpenRobotics/Desk", 3, 2, yaw=math.pi / 2))
    assert (desk.name, desk.estimated, desk.height) == ("thing", True, 0.75)
    np.testing.assert_allclose(desk.polygon.min(axis=0), (2.25, 1.625), atol=1e-9)
    np.testing.assert_allclose(desk.polygon.max(axis=0), (3.75, 2.375), atol=1e-9)
    ahead = np.roll(desk.polygon, -1, axis=0)
    assert (desk.polygon[:, 0] * ahead[:, 1] - desk.polygon[:, 1] * ahead[:, 0]).sum() > 0, "counter-clockwise"


def test_an_estimate_that_blocks_a_lane_is_left_out_and_named(load):
    world = load(ROOM % ", ".join([model("Desk", 3, 1), model("Desk", 5, 1.2)]))
    assert [obstacle.polygon[:, 0].mean() for obstacle in world.levels[0].obstacles] == pytest.approx([5])
    (note,) = world.notes
    assert "'Desk'" in note
    assert "within 0.35 m of a lane" in note
    assert "a – b; 1 in all" in note
    assert len(obstacles(load, model("Desk", 3, 1), clearance=0.2)) == 1


def test_a_measured_footprint_stays_even_if_it_blocks_a_lane(load, tmp_path):
    own = tmp_path / "own.yaml"
    own.write_text("Desk: {size: [1, 1], centre: [0.5, 0], height: 2}\nThrone: {radius: 0.5}\n")
    desk, throne = obstacles(load, model("Desk", 3, 0), model("Throne", 5, 0), footprints=own)
    assert (desk.estimated, desk.height) == (False, 2)
    np.testing.assert_allclose(desk.polygon.min(axis=0), (3, -0.5))
    assert np.hypot(*(throne.polygon - (5, 0)).T) == pytest.approx(0.5)


def test_models_out_of_reach_or_without_a_footprint_are_left_out_and_named(load):
    world = load(ROOM % ", ".join([model("Coke", 3, 3, z=0.9), model("Throne", 4, 4), model("BedSheet", 5, 5)]))
    assert world.levels[0].obstacles == ()
    for part in ("'Coke' is higher than", "'Throne' has no known footprint", "'BedSheet' is not an"):
        assert any(part in note for note in world.notes), part


def test_an_origin_above_the_foot_counts(load):
    assert len(obstacles(load, model("Shower", 3, 3, z=1))) == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Desk: {size: [1]}", "own.yaml:1:14: should have at least 2 values"),
        ("Desk: {size: [1, 0]}", "own.yaml:1:18: should be positive"),
        ("Desk: {size: [1, 2, 3]}", "two numbers"),
        ("Desk: {radius: 1, size: [1, 1]}", "either size or radius"),
        ("Desk: {diameter: 1}", "own.yaml:1:8: unknown key 'diameter' (a footprint has size, radius"),
        ("Desk: 5", "should be a mapping"),
    ],
)
def test_a_mistake_in_a_table_is_named_with_its_line(load, tmp_path, text, message):
    own = tmp_path / "own.yaml"
    own.write_text(text)
    with pytest.raises(InputError) as caught:
        obstacles(load, footprints=own)
    assert message in str(caught.value)


def test_a_model_without_a_place_is_refused(load):
    with pytest.raises(InputError, match="a model needs model_name, x and y"):
        obstacles(load, "{model_name: Desk, x: 1}")


def test_estimates_are_of_the_size_of_furniture():
    table = Footprints()
    import yaml

    for name in yaml.safe_load(SHIPPED.read_text()):
        footprint = table.get(f"OpenRobotics/{name}")
        if len(footprint.polygon):
            assert 0.05 <= np.ptp(footprint.polygon, axis=0).min() <= np.ptp(footprint.polygon, axis=0).max() <= 12
            assert 0.1 <= footprint.height <= 6
