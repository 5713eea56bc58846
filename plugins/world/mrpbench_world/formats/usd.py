"""Stages of OpenUSD (`.usd`, `.usda`, `.usdc`), for Omniverse, Isaac Sim and other viewers; z up, metres.

Solids have colliders (UsdPhysics). The motion of a recorded run is the animation of its robots: one time code for each
sample, so that the stage plays as long as the run.
"""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from mrpbench_core.files.errors import InputError
from mrpbench_world.formats.libraries import library
from mrpbench_world.formats.meshes import mesh
from mrpbench_world.scene import Motion, Scene
from mrpbench_world.solids import BLUE, GREY, WOOD, Prism


def write_usd(scene: Scene, file: Path) -> None:
    """Write a stage.

    Raises:
        InputError: `usd-core` is not installed, or the file cannot be written.
    """
    pxr = library("pxr", "usd")
    for name in ("Gf", "Tf", "Usd", "UsdGeom", "UsdPhysics"):
        library(f"pxr.{name}", "usd")
    if not file.parent.is_dir():  # which a stage would make
        raise InputError("cannot be written: its folder does not exist", file=file)
    file.unlink(missing_ok=True)  # a stage is not created over a file
    try:
        stage = pxr.Usd.Stage.CreateNew(str(file))
    except pxr.Tf.ErrorException as error:
        raise InputError("cannot be written", file=file) from error
    pxr.UsdGeom.SetStageUpAxis(stage, pxr.UsdGeom.Tokens.z)
    pxr.UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    world = pxr.UsdGeom.Xform.Define(stage, "/World")
    stage.SetDefaultPrim(world.GetPrim())
    for group, prisms, colour in (
        ("Floors", scene.floors, GREY),
        ("Walls", scene.walls, GREY),
        ("Doors", [leaf.prism for leaf in scene.leaves], WOOD),
    ):
        pxr.UsdGeom.Xform.Define(stage, f"/World/{group}")
        for prism in prisms:
            _mesh(pxr, stage, _free(stage, f"/World/{group}/{_identifier(prism.name)}"), prism, colour)
    pxr.UsdGeom.Xform.Define(stage, "/World/Robots")
    for index, robot in enumerate(scene.robots):
        path = f"/World/Robots/{robot.name}"
        placed = pxr.UsdGeom.Xform.Define(stage, path)
        move, turn = placed.AddTranslateOp(), placed.AddRotateZOp()
        move.Set(pxr.Gf.Vec3d(robot.pose[0], robot.pose[1], robot.elevation))
        turn.Set(math.degrees(robot.pose[2]))
        for prism in robot.body():
            _mesh(pxr, stage, f"{path}/{prism.name}", prism, BLUE)
        if scene.motion is not None:
            _animate(pxr, move, turn, scene.motion, index)
    if scene.motion is not None:
        _time_codes(stage, scene.motion)
    stage.GetRootLayer().Save()


def _mesh(pxr: Any, stage: Any, path: str, prism: Prism, colour: tuple[float, float, float]) -> None:
    corners, triangles = mesh(prism)
    part = pxr.UsdGeom.Mesh.Define(stage, path)
    points = [pxr.Gf.Vec3f(*point) for point in corners.tolist()]
    part.CreatePointsAttr(points)
    part.CreateFaceVertexCountsAttr([3] * len(triangles))
    part.CreateFaceVertexIndicesAttr(triangles.ravel().tolist())
    part.CreateSubdivisionSchemeAttr(pxr.UsdGeom.Tokens.none)
    part.CreateExtentAttr(pxr.UsdGeom.PointBased.ComputeExtent(part.GetPointsAttr().Get()))
    part.CreateDisplayColorAttr([pxr.Gf.Vec3f(*colour)])
    pxr.UsdPhysics.CollisionAPI.Apply(part.GetPrim())


def _animate(pxr: Any, move: Any, turn: Any, motion: Motion, robot: int) -> None:
    for code, (x, y, z, yaw) in enumerate(motion.pose[:, robot].tolist()):
        if not math.isnan(x):
            move.Set(pxr.Gf.Vec3d(x, y, z), code)
            turn.Set(math.degrees(yaw), code)


def _time_codes(stage: Any, motion: Motion) -> None:
    """Time code i is sample i, which comes as fast as in the run: samples are evenly spaced."""
    step = float(np.median(np.diff(motion.time))) if len(motion.time) > 1 else 1.0
    stage.SetStartTimeCode(0)
    stage.SetEndTimeCode(len(motion.time) - 1)
    stage.SetTimeCodesPerSecond(1 / step)
    stage.SetFramesPerSecond(1 / step)


def _free(stage: Any, path: str) -> str:
    """A path that no prim has: names that differ in other characters only may become the same identifier."""
    while stage.GetPrimAtPath(path):
        path += "_"
    return path


def _identifier(name: str) -> str:
    """A name that a stage accepts."""
    text = re.sub(r"\W", "_", name, flags=re.ASCII)
    return text if not text[:1].isdigit() else f"_{text}"
