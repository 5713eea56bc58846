"""Robots with batteries: what they use, and when and where they charge.

`battery` is the model of a battery, `site` says where chargers are, and `ledger` keeps the state of charge of a fleet
from its true motion; the task source in `charging` and the metric in `metric` both ask it.
"""

from mrpbench_energy.battery import Battery
from mrpbench_energy.charging import Charging
from mrpbench_energy.metric import EnergyUse
from mrpbench_energy.site import Energy

__all__ = ["Battery", "Charging", "Energy", "EnergyUse"]
