"""Executes runs: pipeline, mission, worker slots, seeds."""
