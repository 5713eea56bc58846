"""Options of the rolling costmap, by the names and defaults of Nav2's local costmap."""

import json
from typing import Any, Literal, get_args

import attrs
import numpy as np
from attrs.validators import deep_iterable, gt, in_
from mrpbench_native.local import robot_options

from mrpbench_core.api.described import DescribedOption, described
from mrpbench_core.api.nav2 import as_parameter, parameter, settle
from mrpbench_core.files.nav2 import Nav2Block
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

    def settings(self, robot: RobotModel, block: Nav2Block | None) -> tuple[dict[str, Any], Float]:
        """Return the settings of one robot's costmap for the native part, and its footprint f8[k,2].

        Raises:
            InputError: the Nav2 file has a value that is not supported.
        """
        given = attrs.asdict(self, recurse=False)
        layers = self.plugins or settle(self, None, of=LocalCostmap)["plugins"]
        values = settle(self, block, of=CostmapGrid)
        inflation, observation = settle(self, of=InflationLayer), settle(self, of=ObservationSource)
        polygon = self._polygon(robot, block)
        if block is not None:
            named = {name: _kind(block, name) for name in block.take_names("plugins")}
            layers = self.plugins or tuple(named.values()) or layers
            for name, kind in named.items():
                if kind == "inflation_layer":
                    inflation = settle(self, block, f"{name}.", of=InflationLayer)
                elif kind in ("obstacle_layer", "voxel_layer"):
                    for source in block.take(f"{name}.observation_sources", str, "").split():
                        observation = settle(self, block, f"{name}.{source}.", of=ObservationSource)
                        if given[_NOT_AS_NAV2] is None:
                            observation[_NOT_AS_NAV2] = block.take(f"{name}.{source}.{_NOT_AS_NAV2}", bool, False)
                        if block.take(f"{name}.{source}.observation_persistence", float, 0.0):
                            raise block.error(
                                "must be 0.0, only the newest scan marks cells",
                                f"{name}.{source}.observation_persistence",
                            )
                        block.ignore(*(f"{name}.{source}.{word}" for word in _OF_SOURCES))
                    cleared = block.take(f"{name}.footprint_clearing_enabled", bool)
                    if cleared is not None and given["footprint_clearing_enabled"] is None:
                        values["footprint_clearing_enabled"] = cleared
                block.ignore(*(f"{name}.{word}" for word in _OF_LAYERS))
            block.ignore(*_IGNORED, *(name for name in _LAYERS if named and name not in named))
            block.refuse_unknown()
        values |= inflation | observation
        radius = values.pop("robot_radius")
        values |= {
            "robot_radius": robot.radius if radius is None else radius,
            "by_radius": polygon is None,
            "obstacle_layer": "obstacle_layer" in layers or "voxel_layer" in layers,
            "static_layer": "static_layer" in layers,
            "inflation_layer": "inflation_layer" in layers,
        }
        return values, robot.footprint if polygon is None else polygon

    def _polygon(self, robot: RobotModel, block: Nav2Block | None) -> Float | None:
        if self.footprint is not None:
            return robot.footprint if self.footprint == "robot" else np.array(self.footprint, float)
        text = None if block is None else block.take("footprint", str)
        if not text or block is None or self.robot_radius is not None:
            return None
        try:
            polygon = np.array(json.loads(text), float)
        except (ValueError, TypeError, RecursionError, OverflowError):
            polygon = np.empty(0)
        if polygon.ndim != 2 or polygon.shape[1] != 2 or len(polygon) < 3 or not np.isfinite(polygon).all():
            raise block.error("must be a string with a list of at least three points [x, y]", "footprint")
        return polygon


def _kind(block: Nav2Block, name: str) -> Layer | None:
    """Return the layer that a plugin of the costmap is, or None when it is disabled."""
    kind = block.take(f"{name}.plugin", str, name).rpartition("::")[2]
    enabled = block.take(f"{name}.enabled", bool, True)
    known: dict[str, Layer] = {
        "ObstacleLayer": "obstacle_layer",
        "VoxelLayer": "voxel_layer",
        "StaticLayer": "static_layer",
        "InflationLayer": "inflation_layer",
    }
    if kind not in known:
        raise block.error(f"{kind!r} is not an implemented layer", f"{name}.plugin")
    return known[kind] if enabled else None


_LAYERS = get_args(Layer)
"""Nav2's own file has blocks of layers that its list of plugins leaves out; they are ignored."""
_OF_SOURCES = (
    "topic",
    "data_type",
    "max_obstacle_height",
    "min_obstacle_height",
    "sensor_frame",
    "expected_update_rate",
)
_OF_LAYERS = (
    *("plugin", "enabled", "publish_voxel_map", "origin_z", "z_resolution", "z_voxels", "max_obstacle_height"),
    *(
        "min_obstacle_height",
        "mark_threshold",
        "unknown_threshold",
        "map_subscribe_transient_local",
    ),
    *("combination_method", "inflate_unknown", "inflate_around_unknown"),
)
"""Parameters without effect here: of the third dimension, of topics, and of unknown cells, which do not exist."""
_IGNORED = (
    *("use_sim_time", "publish_frequency", "global_frame", "robot_base_frame", "rolling_window", "filters"),
    *("always_send_full_costmap", "transform_tolerance", "track_unknown_space", "plugin_names", "plugin_types"),
    *("origin_x", "origin_y", "lethal_cost_threshold", "unknown_cost_value", "trinary_costmap", "map_topic"),
)
