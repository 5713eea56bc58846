"""Immutable data that crosses the seams between stages: NumPy and attrs only."""
