"""Worlds from files: RMF buildings, maps of ROS and MovingAI, the worlds of BARN, and worlds of this project.

- `rmf`, `building`: RMF `building.yaml` files; `shipped`, `data`: the worlds that come with this package.
- `ros_map`, `image`, `rotation`: maps of the ROS `map_server`.
- `movingai`, `movingai_scenario`: maps and scenarios of the MovingAI benchmarks.
- `barn`, `dynabarn`, `barn_task`: the worlds and the task of the BARN and DynaBARN challenges.
- `generated`: worlds made from a few numbers and a seed.
"""
