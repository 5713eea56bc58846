"""Loads studies as plain data, in a worker: their runs, with the versions of their components."""
