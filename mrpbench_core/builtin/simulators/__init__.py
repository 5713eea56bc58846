"""The simulator that needs only NumPy."""
