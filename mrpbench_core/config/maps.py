"""Maps that are named by their file, without the plugin that reads them."""

from pathlib import Path

from mrpbench_core.files.yaml import load

SUFFIXES = (".map", ".yaml", ".yml", ".json")


def map_plugin(file: Path) -> str | None:
    """Return the plugin that reads a file, or None if its name is not that of a map.

    Raises:
        InputError: it has to be read to tell, and cannot be.
    """
    if file.suffix == ".map":
        return "movingai"
    if file.suffix not in SUFFIXES:
        return None
    data = load(file).data
    return "ros_map" if isinstance(data, dict) and not {"image", "resolution"}.isdisjoint(data) else "rmf"
