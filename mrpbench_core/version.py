"""The version of the core, from the metadata of its distribution."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("mrpbench-core")
except PackageNotFoundError:  # a folder on the path, not an installation
    __version__ = "0+unknown"
