"""Finished runs: statuses, recordings and their context."""
