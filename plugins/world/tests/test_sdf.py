"""Files for Gazebo: what is solid in them is what is solid in the world."""

import math
from xml.etree import ElementTree as ET

import attrs
import numpy as np
import pytest
from mrpbench_world.formats.sdf import write_sdf
from mrpbench_world.scene import robots_of, scene_of
from mrpbench_worlds_standard.shipped import Airport, Office, Warehouse

from mrpbench_core.checking.occupancy import rasterise
from mrpbench_core.files.errors import InputError
from mrpbench_core.model.worlds.world import Level, Obstacle


def numbers(text):
    return [float(word) for word in text.split()]


def solid_polygons(sdf, height):
    """Bases of all collisions of the model `walls` that reach a height, read as sdformat defines them."""
    (walls,) = [model for model in ET.fromstring(sdf).iter("model") if model.get("name") == "walls"]
    for shape in walls.iter("collision"):
        x, y, z, _, _, yaw = numbers(shape.findtext("pose"))
        turn = np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
        if (size := shape.findtext("geometry/box/size")) is not None:
            length, width, tall = numbers(size)
            base = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (length / 2, width / 2)
            low, high = z - tall / 2, z + tall / 2
        else:
            line = shape.find("geometry/polyline")
            base = np.array([numbers(point.text) for point in line.findall("point")])[:-1]
            low, high = z, z + float(line.findtext("height"))
        if low <= height < high:
            yield base @ turn + (x, y)


@pytest.mark.parametrize("name", ["room", "cells", "office", "warehouse", "airport"])
def test_the_solids_are_those_of_the_world(name, request):
    shipped = {"office": Office, "warehouse": Warehouse, "airport": Airport}
    world = shipped[name]().load() if name in shipped else request.getfixturevalue(name)
    level = world.levels[0]
    polygons = list(solid_polygons(write_sdf(scene_of(world)), level.elevation + 0.1))
    again = Level(name="L1", obstacles=[Obstacle(name="it", polygon=polygon) for polygon in polygons])
    ours = rasterise(attrs.evolve(level, holes=()), 0.05)
    theirs = rasterise(again, 0.05, origin=ours.origin, shape=ours.shape)
    assert (ours.blocked == theirs.blocked).mean() >= 0.999
    assert ours.blocked.any()


def test_doors_turn_and_slide_until_they_are_open(room):
    models = {model.get("name"): model for model in ET.fromstring(write_sdf(scene_of(room))).iter("model")}
    swing, slide = models["L1_swing_0"].find("joint"), models["L1_slide_0"].find("joint")
    assert swing.get("type") == "revolute"
    assert numbers(swing.findtext("pose"))[:2] == [3.0, 1.0]
    assert float(swing.findtext("axis/limit/upper")) == pytest.approx(math.pi / 2)
    assert numbers(swing.findtext("axis/xyz")) == [0, 0, -1]  # to the right, seen from start to end
    assert slide.get("type") == "prismatic"
    assert numbers(slide.findtext("axis/xyz")) == [0, 1, 0]
    assert float(slide.findtext("axis/limit/upper")) == pytest.approx(0.9)


def test_topics_of_doors_have_no_spaces(room):
    level = room.levels[0]
    named = attrs.evolve(room, levels=(attrs.evolve(level, doors=(attrs.evolve(level.doors[0], name="main door"),)),))
    topics = [plugin.findtext("topic") for plugin in ET.fromstring(write_sdf(scene_of(named))).iter("plugin")]
    assert "/L1_main_door_0/position" in topics


def test_robots_have_their_drive_and_lidar(recording):
    robots = robots_of(recording)
    models = {
        model.get("name"): model
        for model in ET.fromstring(write_sdf(scene_of(recording.context().world, robots))).iter("model")
    }
    for robot in robots:
        model = models[robot.name]
        x, y, z, _, _, yaw = numbers(model.findtext("pose"))
        assert (x, y, z, yaw) == pytest.approx((*robot.pose[:2], robot.elevation, robot.pose[2]))
        (drive,) = [it for it in model.findall("plugin") if it.get("filename") == "gz-sim-diff-drive-system"]
        assert float(drive.findtext("wheel_separation")) == robot.model.wheel_separation
        assert drive.findtext("topic") == f"/{robot.name}/cmd_vel"
        assert {link.get("name") for link in model.findall("link")} == {"base_footprint", "left_wheel", "right_wheel"}
        if robot.model.lidar is not None:
            horizontal = model.find("link/sensor/lidar/scan/horizontal")
            assert int(float(horizontal.findtext("samples"))) == robot.model.lidar.beams


def test_levels_at_one_elevation_cannot_be_in_one_file(room):
    two = attrs.evolve(room, levels=(room.levels[0], attrs.evolve(room.levels[0], name="L2")))
    with pytest.raises(InputError, match="same elevation"):
        scene_of(two)
