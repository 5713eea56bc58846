"""The features of a problem, and the vertices of its goals."""

import attrs
import numpy as np

from mrpbench_core.engine.prepare.problem_building import problem_with_features
from mrpbench_core.model.common.fleet import Fleet
from mrpbench_core.model.planning.goals import goal_vertices
from mrpbench_core.model.planning.problem import Feature

GOALS = (((1,),), ((2,),))


def features(roadmap, robots, goals=GOALS):
    return problem_with_features(roadmap, Fleet(robots=robots), np.array([0, 1]), goals).features


def test_small_robots_on_a_unit_raster_need_nothing(corridor, robot_model):
    assert features(corridor, (robot_model, robot_model)) == frozenset()


def test_robots_wider_than_a_cell_need_footprints(corridor, robot_model):
    wide = attrs.evolve(robot_model, name="wide", footprint=robot_model.footprint * 6)
    assert Feature.FOOTPRINTS in features(corridor, (wide, wide))
    assert Feature.FOOTPRINTS not in features(corridor, (wide, robot_model))


def test_a_roadmap_that_is_not_a_raster_needs_footprints(corridor, robot_model):
    graph = attrs.evolve(corridor, grid=None, duration=[[3, 3, 2, 2]])
    assert features(graph, (robot_model, robot_model)) == {Feature.FOOTPRINTS, Feature.EDGE_DURATIONS}


def test_a_robot_without_a_task_may_end_anywhere(corridor, robot_model):
    assert Feature.GOAL_SEQUENCES in features(corridor, (robot_model, robot_model), (((1,),), ()))


def test_goals_are_in_the_cells_that_contain_them(run_context):
    assert goal_vertices(run_context.problem.roadmap, run_context.scenario) == [((1,),), ((2,),)]
