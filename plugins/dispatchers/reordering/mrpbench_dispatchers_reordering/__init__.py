"""Dispatchers that change the order of a plan when robots are late."""

from mrpbench_dispatchers_reordering.btpg import Btpg
from mrpbench_dispatchers_reordering.gses import Gses
from mrpbench_dispatchers_reordering.sadg import Sadg

__all__ = ["Btpg", "Gses", "Sadg"]
