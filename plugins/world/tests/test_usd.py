"""Stages of OpenUSD: validators accept them, and robots move as recorded."""

import math

import numpy as np
import pytest
from mrpbench_world.formats.usd import write_usd
from mrpbench_world.scene import motion_of, robots_of, scene_of

from mrpbench_core.files.errors import InputError

pxr = pytest.importorskip("pxr")
from pxr import Usd, UsdGeom, UsdPhysics, UsdValidation  # noqa: E402 - after the check that it is installed


@pytest.fixture
def stage(recording, tmp_path):
    file = tmp_path / "run.usda"
    write_usd(scene_of(recording.context().world, robots_of(recording), motion_of(recording)), file)
    return Usd.Stage.Open(str(file))


def test_no_validator_of_usd_objects(stage):
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) > 20
    errors = UsdValidation.ValidationContext(validators).Validate(stage)
    assert [error.GetMessage() for error in errors] == []


def test_robots_move_as_recorded(stage, recording):
    motion = motion_of(recording)
    assert stage.GetTimeCodesPerSecond() == pytest.approx(10)
    for index, name in enumerate(recording.context().fleet.names):
        move, turn = UsdGeom.Xformable(stage.GetPrimAtPath(f"/World/Robots/{name}")).GetOrderedXformOps()
        for code in range(len(motion.time)):
            assert tuple(move.Get(code)) == pytest.approx(motion.pose[code, index, :3])
            assert turn.Get(code) == pytest.approx(math.degrees(motion.pose[code, index, 3]), abs=1e-3)
    assert np.abs(np.diff(motion.pose[..., 3], axis=0)).max() < 1  # no jump where the yaw passes pi


def test_solids_have_colliders(stage):
    for group in ("Walls", "Floors", "Doors"):
        parts = stage.GetPrimAtPath(f"/World/{group}").GetChildren()
        assert parts
        assert all(part.HasAPI(UsdPhysics.CollisionAPI) for part in parts)


def test_a_file_is_replaced(recording, tmp_path):
    scene = scene_of(recording.context().world)
    for _ in range(2):
        write_usd(scene, tmp_path / "again.usdc")
    assert Usd.Stage.Open(str(tmp_path / "again.usdc")).GetDefaultPrim().GetName() == "World"


def test_a_missing_folder_is_named(room, tmp_path):
    with pytest.raises(InputError, match=r"a\.usda: cannot be written: its folder does not exist"):
        write_usd(scene_of(room), tmp_path / "no" / "a.usda")
    assert not (tmp_path / "no").exists()
