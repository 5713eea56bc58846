"""Instances are kept by their content, and are read as they were written."""

import attrs
import numpy as np
import pytest

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.planning.problem import Feature
from mrpbench_core.model.runs.instance import Instance
from mrpbench_core.store.instances import InstanceFolder, inlined, inlined_array
from mrpbench_core.store.recording import Recording, RecordingWriter


@pytest.fixture
def instance(run_context) -> Instance:
    problem = attrs.evolve(
        run_context.problem, radius=run_context.fleet.radii, features=frozenset({Feature.FOOTPRINTS})
    )
    return attrs.evolve(run_context.instance, problem=problem, assigned=(0, 1))


def files(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def test_an_instance_is_read_as_it_was_written(instance, tmp_path):
    name = InstanceFolder(tmp_path).write(instance)
    again = InstanceFolder(tmp_path).read(name)
    assert again.world == instance.world
    assert again.fleet == instance.fleet
    assert again.scenario == instance.scenario
    assert again.problem == instance.problem
    assert again.assigned == (0, 1)


def test_equal_instances_have_one_name_and_the_same_files(instance, tmp_path):
    first = InstanceFolder(tmp_path / "a").write(instance)
    folder = InstanceFolder(tmp_path / "b")
    assert folder.write(instance) == folder.write(attrs.evolve(instance)) == first
    assert files(tmp_path / "a") == files(tmp_path / "b")
    assert {file.name for file in folder.files_of(first)} == files(tmp_path / "b").keys()


def test_instances_of_one_world_share_its_file(instance, tmp_path):
    folder = InstanceFolder(tmp_path)
    names = {folder.write(attrs.evolve(instance, assigned=assigned)) for assigned in ((0, 1), (1, 0), None)}
    assert len(names) == 3
    assert len([*tmp_path.glob("*.json")]) == 3
    assert len([*tmp_path.glob("*.zip")]) == 1


def test_goals_anywhere_take_no_room(instance, tmp_path):
    anywhere = (tuple(range(3)),)
    wide = attrs.evolve(instance, problem=attrs.evolve(instance.problem, goals=(anywhere, ((2,),))))
    folder = InstanceFolder(tmp_path)
    name = folder.write(wide)
    assert '"goals": [null, [[2]]]' in (tmp_path / f"{name}.json").read_text()
    assert InstanceFolder(tmp_path).read(name).problem.goals == (anywhere, ((2,),))


@pytest.mark.parametrize("suffix", ["json", "zip"])
def test_a_file_that_was_changed_is_refused(instance, tmp_path, suffix):
    name = InstanceFolder(tmp_path).write(instance)
    (file,) = tmp_path.glob(f"*.{suffix}")
    file.write_bytes(file.read_bytes() + b" ")
    with pytest.raises(InputError, match="is not the instance of this name: its SHA-256 differs"):
        InstanceFolder(tmp_path).read(name)


def test_an_instance_that_is_not_here_is_named(tmp_path):
    with pytest.raises(InputError, match=r"0{64}\.json: cannot be read: No such file or directory"):
        InstanceFolder(tmp_path).read("0" * 64)


def test_a_recording_is_read_with_the_instance_that_it_names(instance, run_context, tmp_path):
    context = attrs.evolve(run_context, problem=instance.problem, assigned=(0, 1))
    name = InstanceFolder(tmp_path / "instances").write(instance)
    writer = RecordingWriter(tmp_path / "recordings" / "run.zip", context, name)
    writer.close()
    recording = Recording(tmp_path / "recordings" / "run.zip")
    again = recording.first_context()
    recording.close()
    assert again.result == context.result
    assert again.problem == context.problem
    assert [route.waypoint.tolist()[-1][:2] for route in again.routes] == [[1.5, 0.5], [2.5, 0.5]]
    assert (again.goal_tolerance, again.plan_filter, again.planner_assigns) == (0.7, "none", False)


@pytest.mark.parametrize("dtype", ["i4", "f8", "?", "i2"])
@pytest.mark.parametrize("shape", [(0,), (3,), (2, 3), (0, 3)])
def test_arrays_in_text_keep_type_and_shape(dtype, shape):
    array = np.arange(np.prod(shape)).reshape(shape).astype(dtype)
    again = inlined_array(inlined(array))
    assert again.dtype == array.dtype
    assert again.shape == shape
    assert (again == array).all()
