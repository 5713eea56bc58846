"""Reads results folders: runs as columns of numbers, the meaning of each column, the differences of configurations."""
