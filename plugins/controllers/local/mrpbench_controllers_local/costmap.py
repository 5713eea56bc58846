"""Options of the rolling costmap, by the names and defaults of Nav2's local costmap."""

from typing import Any, Literal, get_args

import attrs
import numpy as np
from attrs.validators import deep_iterable, gt, in_
from mrpbench_native.local import robot_options

from mrpbench_controllers_local.nav2_names import OF_COSTMAPS, OF_LAYERS, OF_SOURCES, OLDER_RANGES
from mrpbench_core.api.described import DescribedOption, described
from mrpbench_core.api.nav2 import as_parameter, parameter, resolve_options
from mrpbench_core.files import yaml
from mrpbench_core.files.errors import InputError
from mrpbench_core.files.nav2 import OF_EVERY_NODE, Nav2Block
from mrpbench_core.files.nav2_file import Nav2File
from mrpbench_core.model.common.arrays import Float
from mrpbench_core.model.common.fleet import RobotModel

Layer = Literal["obstacle_layer", "voxel_layer", "static_layer", "inflation_layer"]
Polygon = tuple[tuple[float, float], ...]
_NOT_AS_NAV2 = "inf_is_valid"
"""The parameter whose default is true unless a Nav2 file is read. With Nav2's, false, marks of robots that drove on
stay where no wall is in range behind them."""


@attrs.frozen(kw_only=True, slots=False)
@described(robot_options("inflation"), as_parameter)
class InflationLayer:
    """The decrease of costs around obstacles (Nav2: the inflation layer)."""


def _of_observation(row: DescribedOption) -> tuple[Any, Any]:
    kind, field = as_parameter(row)
    if row.name == _NOT_AS_NAV2:
        field = parameter(True, help=f"{row.help}; in a Nav2 file false unless it is set")
    return kind, field


@attrs.frozen(kw_only=True, slots=False)
@described(robot_options("observation"), _of_observation)
class ObservationSource:
    """Marking and clearing of cells by scans (Nav2: an observation source)."""


@attrs.frozen(kw_only=True, slots=False)
@described(robot_options("costmap_grid"), as_parameter)
class CostmapGrid:
    """The size of the costmap, and how often it is updated."""

    robot_radius: float | None = parameter(
        None,
        help="treat the robot as a disc of this radius; by default its circumscribed disc",
        unit="m",
        validator=gt(0),
    )


@attrs.frozen(kw_only=True, slots=False)
class LocalCostmap(CostmapGrid, InflationLayer, ObservationSource):
    """A costmap that rolls with the robot."""

    plugins: tuple[Layer, ...] | None = parameter(
        ("voxel_layer", "inflation_layer"),
        help="layers; voxel_layer is the same as obstacle_layer, since lidars are planar",
        validator=deep_iterable(in_(get_args(Layer))),
    )
    footprint: Literal["robot"] | Polygon | None = attrs.field(
        default=None,
        metadata={"help": "use this shape instead of a disc: `robot`, or a polygon of points [x, y]", "unit": None},
    )

    def settings(self, robot: RobotModel, block: Nav2Block | None) -> tuple[dict[str, Any], Polygon]:
        """Return the settings of one robot's costmap for the native part, and its footprint.

        Raises:
            InputError: the Nav2 file has a value that is not supported.
        """
        values = resolve_options(self, block, of=CostmapGrid)
        values |= resolve_options(self, of=InflationLayer) | resolve_options(self, of=ObservationSource)
        layers = self.plugins or resolve_options(self, of=LocalCostmap)["plugins"]
        polygon = self._polygon(robot, block)
        if block is not None:
            block.not_used(*OF_EVERY_NODE, *OF_COSTMAPS)
            block.ignore("plugin_types", *block.take_names("filters"))
            listed = block.take_names("plugins") or block.take_names("plugin_names") or _DEFAULT
            named = {name: self._layer(block.within(name), name) for name in listed}
            layers = self.plugins or tuple(kind for kind, _ in named.values() if kind)
            for _, of_layer in named.values():
                values |= of_layer
        radius = values.pop("robot_radius")
        values |= {
            "robot_radius": robot.radius if radius is None else radius,
            "by_radius": polygon is None,
            "obstacle_layer": "obstacle_layer" in layers or "voxel_layer" in layers,
            "static_layer": "static_layer" in layers,
            "inflation_layer": "inflation_layer" in layers,
        }
        shape = robot.footprint if polygon is None else polygon
        return values, tuple((x, y) for x, y in shape.tolist())

    def _layer(self, layer: Nav2Block, name: str) -> tuple[Layer | None, dict[str, Any]]:
        """Return the layer that a plugin of the costmap is, None when it is disabled, and the values in its block."""
        if not layer.take("enabled", bool, True):
            layer.ignore()
            return None, {}
        layer_type = next((kind for kind, word in _LAYERS.items() if word == name), name)
        kind = layer.take("plugin", str, layer_type).replace("/", "::").rpartition("::")[2]
        if kind not in _LAYERS and self.plugins is not None:
            layer.ignore()
            return None, {}
        if kind not in _LAYERS:
            hint = f"layers: {', '.join(_LAYERS)}; choose some by `local_costmap: {{plugins: [obstacle_layer, …]}}`"
            raise layer.error(f"{kind!r} is not an implemented layer", "plugin", hint=hint)
        layer.not_used(*OF_LAYERS)
        values: dict[str, Any] = {}
        if _LAYERS[kind] == "inflation_layer":
            values = resolve_options(self, layer, of=InflationLayer)
        elif _LAYERS[kind] in ("obstacle_layer", "voxel_layer"):
            values = self._observations(layer)
            cleared = layer.take("footprint_clearing_enabled", bool)
            if cleared is not None and attrs.asdict(self, recurse=False)["footprint_clearing_enabled"] is None:
                values["footprint_clearing_enabled"] = cleared
        return _LAYERS[kind], values

    def _observations(self, layer: Nav2Block) -> dict[str, Any]:
        """Return the values of the first lidar among the sources of a layer; robots have no other sensor here."""
        sources = layer.take("observation_sources", str, "").split()
        lidars = [name for name in sources if layer.take(f"{name}.data_type", str, "LaserScan") == "LaserScan"]
        if not lidars:
            return {}
        source = layer.within(lidars[0])
        source.take("data_type", str)
        source.rename(OLDER_RANGES)
        source.not_used(*OF_SOURCES, *OLDER_RANGES)
        values = resolve_options(self, source, of=ObservationSource)
        if attrs.asdict(self, recurse=False)[_NOT_AS_NAV2] is None:
            values[_NOT_AS_NAV2] = source.take(_NOT_AS_NAV2, bool, False)
        if source.take("observation_persistence", float, 0.0):
            raise source.error("must be 0.0, only the newest scan marks cells", "observation_persistence")
        return values

    def _polygon(self, robot: RobotModel, block: Nav2Block | None) -> Float | None:
        if self.footprint is not None:
            return robot.footprint if self.footprint == "robot" else np.array(self.footprint, float)
        text = None if block is None else block.take("footprint", str)
        if not text or text.split() in ([], ["[]"]) or block is None or self.robot_radius is not None:
            return None
        try:
            polygon = np.array(yaml.loads(text).data, float)
        except (InputError, ValueError, TypeError, OverflowError):
            polygon = np.empty(0)
        if polygon.ndim != 2 or polygon.shape[1] != 2 or len(polygon) < 3 or not np.isfinite(polygon).all():
            raise block.error("must be a string with a list of at least three points [x, y]", "footprint")
        return polygon


def costmap_notes(file: Nav2File, namespace: str) -> tuple[str, ...]:
    """Return the notes that filters of the costmaps are ignored, and that the file has no local costmap."""
    blocks = [file.node(name, namespace) for name in ("local_costmap", "global_costmap") if name in file.nodes]
    filters = dict.fromkeys(name for block in blocks if block is not None for name in block.take_names("filters"))
    notes = [f"filters of costmaps are ignored, their masks are not read: {', '.join(filters)}"] if filters else []
    if "local_costmap" not in file.nodes:
        notes.append(f"no parameters of the node 'local_costmap', so the defaults hold: {', '.join(file.nodes)}")
    return tuple(f"{file.document.file}: {note}" for note in notes)


_LAYERS: dict[str, Layer] = {
    "ObstacleLayer": "obstacle_layer",
    "VoxelLayer": "voxel_layer",
    "StaticLayer": "static_layer",
    "InflationLayer": "inflation_layer",
}
"""The layers of Nav2 that there are here."""
_DEFAULT = ("static_layer", "obstacle_layer", "inflation_layer")
"""The layers that a costmap has in Nav2 unless a file lists others."""
