"""Two levels with a door and a lift, for whatever moves robots between them."""

import numpy as np

from mrpbench_core.model.world import Door, Level, Lift, World
from mrpbench_core.testing.room import HALF_WALL, HEIGHT, WIDTH

DOOR = Door(name="door", start=(2.0, 1.0), end=(2.0, 2.0), motion="sliding")
"""In the wall between the left and the right half of each level; only the lower level has one that can be opened."""
CABIN = (3.2, 1.5)
"""In the right half; its door looks to the left."""
RISE = 3.0
"""metres from one level to the other"""


def building() -> World:
    """Four walls, and one with a doorway, on two levels."""
    corners = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)]
    between = [(2.0, 0.0, 2.0, 1.0), (2.0, 2.0, 2.0, HEIGHT)]
    walls = np.vstack([np.column_stack([corners, corners[1:] + corners[:1]]), between])
    lower = Level(name="L1", walls=walls, wall_thickness=2 * HALF_WALL, doors=(DOOR,))
    upper = Level(name="L2", elevation=RISE, walls=walls, wall_thickness=2 * HALF_WALL)
    x, y = CABIN
    entrance = Door(name="entrance", start=(x - 0.6, y - 0.4), end=(x - 0.6, y + 0.4), motion="double_sliding")
    lift = Lift(
        name="lift",
        x=x,
        y=y,
        yaw=0.0,
        width=1.2,
        depth=1.2,
        levels=(0, 1),
        initial_level=0,
        doors=(entrance,),
        door_levels=((0, 1),),
    )
    return World(name="building", levels=(lower, upper), lifts=(lift,))
