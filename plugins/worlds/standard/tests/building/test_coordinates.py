import math
import sys

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from mrpbench_core.files.errors import InputError

SQUARE = np.array([(0.0, 0.0), (8.0, 0.0), (8.0, 6.0), (0.0, 6.0)])
"""Corners in metres, y up."""


def image(points, pixels_per_metre, angle=0.0, shift=(0.0, 0.0)):
    """Pixels, y down, of points seen in a picture that is turned by `angle` and shifted."""
    turn = np.array([(math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))])
    return (points @ turn * pixels_per_metre + shift) * (1, -1)


def level(pixels, marks, measured=None, **more):
    parts = {
        "vertices": [[*xy, 0, ""] for xy in pixels.tolist()],
        "walls": [[0, 1], [1, 2], [2, 3], [3, 0]],
        "fiducials": [[*xy, name] for name, xy in marks.items()],
        **more,
    }
    if measured is not None:
        parts["measurements"] = [[0, 1, {"distance": [3, measured]}]]
    return parts


def named(points):
    return {f"f{index}": xy for index, xy in enumerate(points.tolist())}


@settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    angle=st.floats(-math.pi, math.pi),
    zoom=st.floats(0.2, 5),
    shift=st.tuples(st.floats(-500, 500), st.floats(-500, 500)),
    marks=st.lists(st.tuples(st.floats(-20, 20), st.floats(-20, 20)), min_size=2, max_size=5),
)
def test_a_turned_and_scaled_level_lies_on_the_reference(load, angle, zoom, shift, marks):
    points = np.array(marks)
    gaps = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))[~np.eye(len(points), dtype=bool)]
    assume(gaps.min() > 0.5)
    first = level(image(SQUARE, 50), named(image(points, 50)), measured=8.0)
    second = level(image(SQUARE, 50 * zoom, angle, shift), named(image(points, 50 * zoom, angle, shift)))
    world = load(yaml.safe_dump({"levels": {"L1": first, "L2": second}}))
    np.testing.assert_allclose(world.levels[0].walls[:, :2], SQUARE, atol=1e-9)
    np.testing.assert_allclose(world.levels[1].walls[:, :2], SQUARE, atol=1e-6)


def test_marks_that_disagree_are_averaged(load):
    marks = image(np.array([(0.0, 0.0), (10.0, 0.0)]), 50)
    longer = image(np.array([(-0.1, 0.0), (10.1, 0.0)]), 50)
    first, second = level(image(SQUARE, 50), named(marks), 8.0), level(image(SQUARE, 50), named(longer))
    walls = load(yaml.safe_dump({"levels": {"L1": first, "L2": second}})).levels[1].walls
    np.testing.assert_allclose(walls[:, :2], (SQUARE - (5, 0)) / 1.02 + (5, 0), atol=1e-9)


def test_without_common_marks_a_level_keeps_its_own_frame_and_says_so(load):
    first = level(image(SQUARE, 50), {"a": [0, 0], "b": [5, 5]}, 8.0)
    second = level(image(SQUARE, 10), {"a": [0, 0], "c": [5, 5]}, 8.0)
    world = load(yaml.safe_dump({"levels": {"L1": first, "L2": second}}))
    np.testing.assert_allclose(world.levels[1].walls[:, :2], SQUARE, atol=1e-9)
    assert any("'L2' shares fewer than two fiducials with 'L1'" in note for note in world.notes)
    second["drawing"] = {"filename": "L2.png"}
    second.pop("measurements")
    with pytest.raises(InputError, match="no measurements"):
        load(yaml.safe_dump({"levels": {"L1": first, "L2": second}}))


def test_models_and_lifts_turn_with_their_level(load):
    angle = math.radians(30)
    first = level(image(SQUARE, 50), named(image(SQUARE, 50)), 8.0)
    x, y = image(np.array([[4.0, 3.0]]), 20, angle)[0].tolist()
    models = [{"model_name": "Desk", "name": "d", "x": x, "y": y, "yaw": angle, "z": 0}]
    second = level(image(SQUARE, 20, angle), named(image(SQUARE, 20, angle)), models=models)
    lift = {"x": x, "y": y, "yaw": angle, "width": 2, "depth": 1, "level_doors": {"L1": ["d"], "L2": ["d"]},
            "reference_floor_name": "L2", "doors": {"d": {"x": 0, "y": 0.5, "width": 0.8}}}  # fmt: skip
    world = load(yaml.safe_dump({"levels": {"L1": first, "L2": second}, "lifts": {"up": lift}}))
    np.testing.assert_allclose(np.ptp(world.levels[1].obstacles[0].polygon, axis=0), (0.75, 1.5), atol=1e-9)
    (cabin,) = world.lifts
    assert (cabin.x, cabin.y, cabin.yaw) == pytest.approx((4, 3, 0))
    np.testing.assert_allclose(cabin.corners, [(3, 2.5), (5, 2.5), (5, 3.5), (3, 3.5)], atol=1e-9)
    assert cabin.doors[0].start == pytest.approx((3.6, 3.5))
    assert cabin.doors[0].end == pytest.approx((4.4, 3.5))


EARTH = """\
coordinate_system: wgs84
parameters: {generate_crs: [1, "EPSG:3414"], suggested_offset_x: [3, 22000], suggested_offset_y: [3, 31500]}
levels:
  L1:
    vertices: [[103.7867, 1.3006, 0, a], [103.7876, 1.3006, 0, b], [103.7867, 1.3015, 0, c]]
    lanes: [[0, 1, {}], [1, 2, {}]]
"""


def test_longitude_and_latitude_become_metres_less_the_offset(load):
    pytest.importorskip("pyproj")
    a, b, c = load(EARTH).vertices
    metre = math.radians(0.0009) * 6378137
    assert (b.x - a.x, b.y - a.y) == pytest.approx((metre, 0), abs=0.3)
    assert (c.x - a.x, c.y - a.y) == pytest.approx((0, metre * 0.9933), abs=0.3)
    # the origin of EPSG:3414, 1°22'00" N 103°50'00" E, is at (28001.642, 38744.572)
    assert a.x == pytest.approx(28001.642 - math.radians(103 + 5 / 6 - 103.7867) * 6378137 - 22000, abs=3)
    assert a.y == pytest.approx(38744.572 - math.radians(1 + 22 / 60 - 1.3006) * 6378137 * 0.9933 - 31500, abs=3)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("EPSG:3414", "EPSG:nonsense", "1:20: generate_crs 'EPSG:nonsense' is not a coordinate reference system"),
        ("generate_crs", "offset_x: [3, 1], crs", "needs the building parameter generate_crs"),
        ("103.7867, 1.3006", "500, 500", "is not a longitude and latitude"),
    ],
)
def test_a_mistake_in_geographic_coordinates_is_one_line(load, old, new, message):
    pytest.importorskip("pyproj")
    with pytest.raises(InputError) as caught:
        load(EARTH.replace(old, new))
    assert message in str(caught.value)


def test_without_pyproj_the_error_names_the_package_to_install(load, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyproj", None)
    with pytest.raises(InputError, match=r"1:20: coordinate_system 'wgs84' needs pyproj .*mrpbench\[geo\]"):
        load(EARTH)


def test_the_suggested_offset_moves_metres_too(load):
    text = EARTH.replace("wgs84", "cartesian_meters")
    assert load(text).vertices[0].x == pytest.approx(103.7867 - 22000)
