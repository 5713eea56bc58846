"""Whatever a plugin left in a folder, the folder can be removed."""

import os

from mrpbench_core.files.removal import remove_tree


def test_a_folder_that_is_deeper_than_calls_may_be_is_removed_and_links_are_not_followed(tmp_path):
    kept, removed = tmp_path / "kept", tmp_path / "removed"
    kept.mkdir()
    (kept / "file").touch()
    removed.mkdir()
    (removed / "link").symlink_to(kept)
    here = os.open(removed, os.O_RDONLY)
    for _ in range(1500):
        os.mkdir("d", dir_fd=here)
        below = os.open("d", os.O_RDONLY, dir_fd=here)
        os.close(here)
        here = below
    os.close(here)
    remove_tree(removed)
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]
    assert (kept / "file").exists()
    remove_tree(removed, ignore_errors=True)
