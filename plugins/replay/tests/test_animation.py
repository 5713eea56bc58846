import attrs
import numpy as np
import pytest
from mrpbench_replay.animation import FRAME_MS, HOLD_MS, PIXELS, write_gif

from mrpbench_core.files.errors import InputError
from mrpbench_core.model.execution.movers import Mover
from mrpbench_core.report.pictures.movers import read_movers
from mrpbench_core.report.pictures.style import COLOURS, PERSON
from mrpbench_core.report.pictures.thumbnail import run_thumbnail
from mrpbench_core.report.pictures.world import plot_world

pytest.importorskip("matplotlib")
images = pytest.importorskip("PIL.Image")


def count(image, colour):
    wanted = [int(colour[index : index + 2], 16) for index in (1, 3, 5)]
    return np.abs(np.asarray(image.convert("RGB")).astype(int) - wanted).max(axis=2) <= 8


def first(chunk, samples):
    return {name: rows[:samples] for name, rows in chunk.items()}


def test_robots_move_through_the_frames(store, chunk, tmp_path):
    write_gif(store(chunk), tmp_path / "a.gif")
    with images.open(tmp_path / "a.gif") as movie:
        assert max(movie.size) == PIXELS
        length = 0
        for frame in range(movie.n_frames):
            movie.seek(frame)
            length += movie.info["duration"]
        assert abs(length - (4000 + HOLD_MS)) <= 2 * FRAME_MS
        middles = []
        for frame in (0, movie.n_frames - 1):
            movie.seek(frame)
            middles.append([np.flatnonzero(count(movie, COLOURS[robot]).any(axis=0)).max() for robot in (0, 1)])
    metre = (middles[0][1] - middles[0][0]) / 1.0
    moved = (np.array(middles[1]) - middles[0]) / metre
    assert np.allclose(moved, 1.0, atol=0.05), "each robot drives one metre to the right"


def test_people_are_in_gifs_pictures_and_thumbnails(store, chunk, tmp_path, run_context):
    samples = len(chunk["time"])
    mover = np.zeros((samples, 2, 5))
    mover[:, 0, :2] = np.stack([np.linspace(0.5, 2.5, samples), np.full(samples, 0.8)], axis=1)
    rows = {"mover": mover, "mover_level": np.tile(np.array([0, -1], "i2"), (samples, 1))}
    context = attrs.evolve(run_context, movers=(Mover(radius=0.25), Mover(radius=0.25)))
    alone, recording = store(chunk), store(chunk | rows, context=context)
    drawn = []
    for shown in (alone, recording):
        write_gif(shown, tmp_path / "a.gif")
        with images.open(tmp_path / "a.gif") as movie:
            movie.seek(movie.n_frames - 1)
            drawn.append(count(movie, PERSON).sum())
        around, poses = shown.context(), read_movers(shown, 0)
        plot_world(around.world, bodies=around.movers, movers=poses, truth=chunk["truth"], file=tmp_path / "a.png")
        with images.open(tmp_path / "a.png") as picture:
            drawn.append(count(picture, PERSON).sum())
        drawn.append(run_thumbnail(shown).count('<polyline class="mover" points="'))
    gif, png, lines = drawn[3:]
    assert drawn[2] == 0
    assert lines == 1, "the other one is absent"
    assert gif > drawn[0] + 20
    assert png > drawn[1] + 20


def test_a_folder_that_does_not_exist_is_named(store, chunk, tmp_path):
    with pytest.raises(InputError, match="cannot be written"):
        write_gif(store(first(chunk, 3)), tmp_path / "no" / "a.gif")


def test_robots_elsewhere_or_unknown_are_left_out(store, chunk, tmp_path, run_context):
    truth, level = chunk["truth"].copy(), chunk["level"].copy()
    truth[:, 0] = np.nan
    level[:, 1] = 1
    world = attrs.evolve(run_context.world, levels=run_context.world.levels * 2)
    context = attrs.evolve(run_context, world=world)
    world_without_robots = store(first(chunk | {"truth": truth, "level": level}, 3), context=context)
    write_gif(world_without_robots, tmp_path / "a.gif")
    with images.open(tmp_path / "a.gif") as movie:
        assert not count(movie, COLOURS[0]).any()
