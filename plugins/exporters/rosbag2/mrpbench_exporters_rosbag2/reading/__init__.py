"""Reads bags, of mrpbench and of other fleets."""
