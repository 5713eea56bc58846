"""Localizers that need only NumPy."""
