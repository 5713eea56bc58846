"""Sites of the site editor: what they say is what the same building says in the traffic editor's file."""

import copy
import json
from pathlib import Path

import numpy as np
import pytest
from mrpbench_worlds_standard.rmf import Rmf

from mrpbench_core.api import InputError, rasterise

SHARED = Path(__file__).parents[5].parent / "shared" / "data" / "rmf_site"
SITE = {
    "format_version": "0.1",
    "properties": {"name": "hut"},
    "levels": {
        "1": {
            "properties": {"name": "ground", "elevation": 0.0},
            "anchors": {str(key): {"Translate2D": [float(key), 2.0 * key]} for key in range(10, 16)},
            "walls": {"30": {"anchors": [10, 11]}},
            "floors": {"31": {"anchors": [10, 12, 14]}},
            "doors": {
                "32": {
                    "anchors": [12, 13],
                    "name": "gate",
                    "kind": {"SingleSwing": {"pivot_on": "Right", "swing": {"Forward": {"rad": 1.5}}}},
                },
                "33": {"anchors": [13, 14], "name": "slide", "kind": {"DoubleSliding": {"left_right_ratio": 0.5}}},
            },
        },
        "2": {"properties": {"name": "upper", "elevation": 3.0}, "anchors": {"20": {"Translate2D": [0.0, 0.0]}}},
    },
    "mutex_groups": {"40": {"name": "aisle"}},
    "navigation": {
        "guided": {
            "graphs": {"50": {"name": "carts"}, "51": {"name": "tugs"}},
            "ranking": [51, 50],
            "lanes": {
                "60": {"anchors": [10, 12], "graphs": {"Only": [51]}, "mutex": 40},
                "61": {
                    "anchors": [12, 14],
                    "forward": {"orientation_constraint": "Forwards", "speed_limit": 0.4},
                    "reverse": "Disable",
                    "graphs": {"AllExcept": [51]},
                },
                "62": {"anchors": [14, 20]},
            },
            "locations": {"70": {"anchor": 10, "tags": ["Charger", {"Workcell": {}}], "name": "dock", "graphs": "All"}},
        }
    },
    "model_descriptions": {
        "80": {"name": "Crate", "source": {"Search": "Acme/Crate"}},
        "81": {"name": "Cart", "source": {"Search": "Acme/Cart"}},
    },
    "robots": {
        "81": {
            "properties": {
                "Collision": {"config": {"radius": 0.25}, "kind": "Circle Collision"},
                "Mobility": {"config": {"translational_speed": 0.5}, "kind": "Differential Drive"},
            }
        }
    },
    "model_instances": {
        "90": {"parent": 1, "name": "a", "pose": {"trans": [1, 2, 0], "rot": {"yaw": {"deg": 90}}}, "description": 80},
        "91": {"parent": 1, "name": "b", "pose": {"trans": [5, 5, 0]}, "description": 80},
        "92": {"parent": 1, "name": "cart1", "pose": {"trans": [10.1, 20, 0]}, "description": 81},
    },
    "scenarios": {"0": {"instances": {"91": {"inclusion": "Hidden"}}}},
}


def load(tmp_path, site, **options):
    file = tmp_path / "hut.site.json"
    file.write_text(json.dumps(site, indent=1))
    (tmp_path / "footprints.yaml").write_text("Acme/Crate: {size: [1.0, 0.5]}\n")
    return Rmf(file=file, footprints=tmp_path / "footprints.yaml", **options).load()


def test_a_site_has_what_the_editor_drew(tmp_path):
    world = load(tmp_path, SITE)
    ground, upper = world.levels
    assert (world.name, ground.name, upper.name, upper.elevation) == ("hut", "ground", "upper", 3.0)
    assert ground.walls.tolist() == [[10, 20, 11, 22]]
    assert ground.floors[0].polygon.tolist() == [[10, 20], [12, 24], [14, 28]]
    gate, slide = ground.doors
    assert (gate.name, gate.motion, gate.motion_axis, gate.motion_direction) == ("gate", "hinged", "end", -1)
    assert gate.motion_degrees == pytest.approx(np.degrees(1.5))
    assert (slide.motion, slide.right_left_ratio) == ("double_sliding", 2.0)


def test_lanes_keep_their_graphs_limits_and_mutexes(tmp_path):
    world = load(tmp_path, SITE)
    two_way, one_way = sorted(world.lanes, key=lambda lane: lane.graph)
    assert (two_way.graph, two_way.bidirectional, two_way.mutex) == (0, True, "aisle")  # the first in the ranking
    assert (one_way.graph, one_way.bidirectional) == (1, False)
    assert (one_way.speed_limit, one_way.orientation) == (0.4, "forward")
    assert any("not on one level" in note for note in world.notes)


def test_robots_begin_at_the_locations_where_they_stand(tmp_path):
    world = load(tmp_path, SITE)
    dock = next(vertex for vertex in world.vertices if vertex.name == "dock")
    wanted = {"is_charger": True, "spawn_robot_name": "cart1", "spawn_robot_type": "Acme/Cart"}
    assert dock.parameters == wanted
    assert any("robot 'Cart': radius 0.25 m, 0.5 m/s" in note for note in world.notes)


def test_hidden_models_are_left_out_and_others_are_obstacles(tmp_path):
    (crate,) = load(tmp_path, SITE).levels[0].obstacles
    assert crate.name == "a"
    assert np.ptp(crate.polygon, axis=0) == pytest.approx([0.5, 1.0])


def test_lifts_are_noted(tmp_path):
    assert any("lifts of sites are not read" in note for note in load(tmp_path, {**SITE, "lifts": {"5": {}}}).notes)


def broken(tmp_path, change):
    site = copy.deepcopy(SITE)
    change(site)
    with pytest.raises(InputError) as caught:
        load(tmp_path, site)
    return str(caught.value)


BROKEN = {
    "format_version 7 is not known": lambda site: site.update(format_version="7"),
    "has no format_version": lambda site: site.pop("format_version"),
    "anchor 99 is not on this level": lambda site: site["levels"]["1"]["walls"]["30"].update(anchors=[10, 99]),
    "an angle should be in deg or rad": lambda site: site["model_instances"]["90"]["pose"]["rot"].update(yaw={}),
    "model description 7 does not exist": lambda site: site["model_instances"]["90"].update(description=7),
    "an anchor should be Translate2D or Pose3D": lambda site: site["levels"]["1"]["anchors"].update({"10": {}}),
    "two levels have the same name": lambda site: site["levels"]["2"]["properties"].update(name="ground"),
}


@pytest.mark.parametrize("said", BROKEN)
def test_broken_sites_are_refused_in_one_line(tmp_path, said):
    text = broken(tmp_path, BROKEN[said])
    assert said in text
    assert "hut.site.json:" in text


def test_sites_in_ron_are_refused(tmp_path):
    file = tmp_path / "hut.site.ron"
    file.write_text('(format_version: "0.1")')
    with pytest.raises(InputError, match=r"sites in RON are not read .*export it as JSON"):
        Rmf(file=file).load()


@pytest.mark.skipif(not SHARED.exists(), reason="the shared data are not here")
def test_the_office_is_the_same_in_both_formats():
    site, building = (Rmf(file=SHARED / f"office.{kind}").load() for kind in ("site.json", "building.yaml"))
    cells = [
        rasterise(world.levels[0], 0.1, origin=(0.0, -14.0), shape=(140, 270)).blocked for world in (site, building)
    ]
    assert np.mean(cells[0] == cells[1]) >= 0.995
    assert [vertex.name for vertex in site.vertices] == [vertex.name for vertex in building.vertices]
    places = [np.array([(vertex.x, vertex.y) for vertex in world.vertices]) for world in (site, building)]
    assert np.abs(places[0] - places[1]).max() < 1e-4
    assert site.lanes == building.lanes
    assert site.levels[0].doors[0].motion == building.levels[0].doors[0].motion
    spawned = [{v.parameters.get("spawn_robot_name") for v in world.vertices} for world in (site, building)]
    assert spawned[0] == spawned[1] == {None, "tinyRobot1", "tinyRobot2"}
