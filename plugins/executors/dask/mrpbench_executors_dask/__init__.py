"""Executor by Dask."""

from mrpbench_executors_dask.executor import Dask

__all__ = ["Dask"]
