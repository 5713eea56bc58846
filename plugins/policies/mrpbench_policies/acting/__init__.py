"""Runs policies: ONNX models and classes in Python files, through one door."""

from mrpbench_policies.acting.acting import Acting, check_choice
from mrpbench_policies.acting.loading import load

__all__ = ["Acting", "check_choice", "load"]
