"""Robots that several tests share."""

from mrpbench_core.files.robot import load_robot

BURGER = load_robot("turtlebot3_burger")
WAFFLE = load_robot("turtlebot3_waffle")
STARTS = [[1, 1, 0.3], [2.3, 1.7, 2], [4.4, 1, -1], [5, 4, 3], [2.5, 4.2, -2.5], [1.75, 1.2, 1]]
"""Of six robots in the furnished room."""
