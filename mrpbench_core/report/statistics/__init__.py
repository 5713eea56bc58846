"""Estimates and tests. They know numbers only, no runs.

Estimates and their intervals need NumPy only. Paired tests come from SciPy, an extra, which functions import when they
are called, since that takes a second.
"""
