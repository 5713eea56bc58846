"""Writes a tuned controller as a Nav2 parameter file."""

import copy
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import attrs
import yaml

from mrpbench_core.api.nav2 import PLUGINS
from mrpbench_core.config.unpacking import unpack
from mrpbench_core.engine.loading.runs import StudyRun
from mrpbench_core.engine.processes.call import in_worker
from mrpbench_core.files.yaml import load

ID = PLUGINS["controller"]


def nav2_file(point: StudyRun) -> dict[str, Any] | None:
    """Return the content of a Nav2 parameter file with the controller of a run; None if Nav2 does not have it."""
    found: dict[str, Any] | None = in_worker("the Nav2 file cannot be written", nav2_content, point.parcel)
    return found


def nav2_content(parcel: Mapping[str, Any]) -> dict[str, Any] | None:
    """In a worker process: see `nav2_file`."""
    controller: Any = unpack(parcel).controller
    plugin = getattr(type(controller), "nav2_plugin", None)
    if plugin is None or not hasattr(controller, "read"):
        return None
    settled = controller.read()[0]
    names = [field.name for field in attrs.fields(type(controller)) if "nav2" in field.metadata]
    values = {name.removesuffix("_"): settled[name] for name in names if settled.get(name) is not None}
    if controller.nav2 is None:
        block = {"plugin": plugin, **_inner(controller), **values}
        return {"controller_server": {"ros__parameters": {"controller_plugins": [ID], ID: block}}}
    document: dict[str, Any] = copy.deepcopy(load(controller.nav2).data)
    for block in _blocks(document, plugin):
        block.update(values)
    return document


def without_nav2(block: Mapping[str, Any], folder: Path, file: Path) -> dict[str, Any]:
    """Return the block of a controller of a study without the options that its Nav2 file gives.

    Args:
        block: with the options of Nav2.
        folder: of the study.
        file: with these options.
    """
    kept = ("plugin", "namespace", "controller_id", "local_costmap", "threads")
    own = {key: value for key, value in block.items() if key in kept}
    return {**own, "nav2": str(file.relative_to(folder))}


def write_nav2(file: Path, content: dict[str, Any], title: str) -> None:
    """Write a Nav2 parameter file."""
    file.write_text(f"# {title}\n{yaml.safe_dump(content, sort_keys=False)}", encoding="utf-8")


def _inner(controller: Any) -> dict[str, Any]:
    """The parameters of a pasted block that are no options, such as those of critics."""
    return {key: value for key, value in controller.FollowPath.items() if key != "plugin"}


def _blocks(data: Any, plugin: str) -> list[dict[str, Any]]:
    """The blocks of a plugin in the content of a file."""
    if not isinstance(data, dict):
        return []
    found = [block for value in data.values() for block in _blocks(value, plugin)]
    return [*found, data] if data.get("plugin") == plugin else found
