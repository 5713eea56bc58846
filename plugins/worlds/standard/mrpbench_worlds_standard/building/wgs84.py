"""Longitude and latitude to metres; needs the extra `geo`."""

from collections.abc import Callable

import numpy as np

from mrpbench_core.files.extras import pip
from mrpbench_core.model.common.arrays import Float
from mrpbench_worlds_standard.building.node import Node


def projection(system: Node, target: str) -> Callable[[Float], Float]:
    """Return a function from (longitude, latitude) f8[k,2] in degrees to (easting, northing) f8[k,2] in metres.

    Args:
        system: the value `wgs84` of the file, for errors.
        target: the coordinate reference system, such as `EPSG:3414`.
    """
    try:
        from pyproj import Transformer
        from pyproj.exceptions import ProjError
    except ImportError:
        raise system.error("coordinate_system 'wgs84' needs pyproj", pip("geo")) from None
    if not target:
        raise system.error("coordinate_system 'wgs84' needs the building parameter generate_crs", "such as EPSG:3414")
    try:
        transformer = Transformer.from_crs("EPSG:4326", target, always_xy=True)
    except ProjError:
        raise system.error(f"generate_crs {target!r} is not a coordinate reference system that pyproj knows") from None

    def project(raw: Float) -> Float:
        easting, northing = transformer.transform(raw[:, 0], raw[:, 1])
        metres: Float = np.stack([easting, northing], axis=1)
        if not np.isfinite(metres).all():
            raise system.error(f"a vertex is not a longitude and latitude that {target} covers")
        return metres

    return project
