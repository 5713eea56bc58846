"""Simulator last_simulator for mrpbench."""

from mrpbench_simulators_last_simulator.last_simulator import LastSimulator

__all__ = ["LastSimulator"]
