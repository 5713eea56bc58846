"""The messages with the occupancy map and the navigation graph of a world."""

import numpy as np

from mrpbench_core.model.worlds.world import World
from mrpbench_exporters_rosbag2.marker import DARK, LINE_LIST, TEXT, marker
from mrpbench_exporters_rosbag2.messages import Topic, header, message, pose, serialize, spatial, time
from mrpbench_exporters_rosbag2.raster import rasterise

LANE = (0.2, 0.5, 0.9, 0.5)
"""Colour."""


def occupancy_map(world: World, index: int, stamp: int, resolution: float) -> tuple[Topic, bytes]:
    """`/map` for the first level, `/map_1` for the second, ..."""
    topic = Topic(f"/map_{index}" if index else "/map", "nav_msgs/OccupancyGrid", latched=True)
    raster = rasterise(world, index, resolution)
    rows, columns = raster.shape
    info = message(
        "nav_msgs/MapMetaData",
        map_load_time=time(stamp),
        resolution=raster.resolution,
        width=columns,
        height=rows,
        origin=pose(spatial(np.array([*raster.origin, 0.0]), world.levels[index].elevation)),
    )
    data = np.where(raster.blocked, 100, 0).astype(np.int8).reshape(-1)
    return topic, serialize(topic.type, message(topic.type, header=header(stamp, "map"), info=info, data=data))


def navigation_graph(world: World, stamp: int) -> tuple[Topic, bytes]:
    """The lanes of the world's navigation graph, and the names of its places."""
    topic = Topic("/navigation_graph", "visualization_msgs/MarkerArray", latched=True)
    places = [(v.x, v.y, world.levels[v.level].elevation) for v in world.vertices]
    ends = [np.array(places[end]) for lane in world.lanes for end in (lane.start, lane.end)]
    middle = spatial(np.zeros(3))
    shapes = [marker("lanes", 0, LINE_LIST, (0.03, 0.0, 0.0), LANE, points=ends, values=middle, stamp=stamp)]
    for index, (vertex, (x, y, z)) in enumerate(zip(world.vertices, places, strict=True)):
        if vertex.name:
            spot = spatial(np.array([x, y, 0.0]), z + 0.1)
            shapes.append(
                marker("places", index, TEXT, (0.0, 0.0, 0.2), DARK, text=vertex.name, values=spot, stamp=stamp)
            )
    return topic, serialize(topic.type, message(topic.type, markers=shapes))
