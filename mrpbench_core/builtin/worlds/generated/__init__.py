"""Worlds made from a few numbers and a seed, for studies of scaling up to a million cells and beyond."""
