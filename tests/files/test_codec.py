"""Worlds survive a recording."""

import json

import attrs

from mrpbench_core.files.codec import decode, encode
from mrpbench_core.model.worlds.occupancy import Occupancy
from mrpbench_core.model.worlds.world import Area, Door, Lane, Level, Lift, Obstacle, Vertex, World


def test_a_world_with_everything_comes_back_equal():
    square = [[0, 0], [1, 0], [1, 1]]
    door = Door(name="d", start=(0.0, 1.0), end=(1.0, 1.0), motion="double_hinged", motion_axis="end")
    level = Level(
        name="L1",
        walls=[[0, 0, 1, 0]],
        doors=(door,),
        obstacles=(Obstacle(name="o", polygon=square, estimated=True),),
        floors=(Area(polygon=square),),
        holes=(Area(polygon=square),),
    )
    lift = Lift(name="up", x=1, y=2, yaw=0.5, width=2, depth=1.5, levels=(0, 1), initial_level=1,
                doors=(door,), door_levels=((0, 1),))  # fmt: skip
    world = World(
        name="w",
        levels=(level, attrs.evolve(level, name="L2")),
        vertices=(Vertex(name="a", x=0.0, y=1.0, level=1, parameters={"is_charger": True}, lift="up"),),
        lanes=(Lane(start=0, end=0, door="d"),),
        lifts=(lift,),
    )
    arrays = {}

    def keep(array):
        arrays[str(len(arrays))] = array
        return str(len(arrays) - 1)

    data = json.loads(json.dumps(encode(world, keep)))
    assert decode(data, World, arrays.__getitem__) == world


def test_the_resolution_of_a_raster_has_its_first_name_in_recordings():
    raster = Occupancy(blocked=[[True, False]], resolution=0.5)
    data = encode(raster, lambda _: "blocked")
    assert data == {"blocked": {"array": "blocked"}, "cell_size": 0.5, "origin": [0.0, 0.0]}
    assert decode(data, Occupancy, lambda _: raster.blocked) == raster
