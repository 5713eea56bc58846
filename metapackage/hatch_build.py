"""The requirements of the distribution `mrpbench`: all distributions of the project in the version of this one."""

from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

DEFAULT = (
    "mrpbench-core",
    "mrpbench-native",
    "mrpbench-standard",
    "mrpbench-analysis",
    "mrpbench-league",
    "mrpbench-publish",
    "mrpbench-replay",
    "mrpbench-scaffold",
    "mrpbench-world",
)
EXTRAS = {
    "dask": "mrpbench-executors-dask",
    "figures": "mrpbench-core[figures]",
    "geo": "mrpbench-standard[geo]",
    "glb": "mrpbench-world[glb]",
    "images": "mrpbench-standard[images]",
    "mujoco": "mrpbench-simulators-mujoco",
    "ortools": "mrpbench-assigners-ortools",
    "parquet": "mrpbench-core[parquet]",
    "policies": "mrpbench-policies[gymnasium,onnx]",
    "pybullet": "mrpbench-simulators-pybullet",
    "ros2": "mrpbench-bridges-ros2",
    "rmf": "mrpbench-live[rmf]",
    "rosbag2": "mrpbench-exporters-rosbag2",
    "search": "mrpbench-search",
    "statistics": "mrpbench-core[statistics]",
    "usd": "mrpbench-world[usd]",
    "vda5050": "mrpbench-live[vda5050]",
}


class Pins(MetadataHookInterface):
    """Pins every requirement, so that `pip install mrpbench==X` gives all parts of one release."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Add the requirements."""
        version = metadata["version"]
        extras = {extra: [f"{name}=={version}"] for extra, name in EXTRAS.items()}
        metadata["dependencies"] = [f"{name}=={version}" for name in DEFAULT]
        metadata["optional-dependencies"] = extras | {"all": [pin for pins in extras.values() for pin in pins]}
