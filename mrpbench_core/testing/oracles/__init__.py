"""Oracles for problems, and the comparison of planners' results with them."""
