"""Worlds generated from a few parameters and a seed, for studies of scaling up to ten million cells."""
