"""Recordings of any fleet, measured as if mrpbench had made them; calibration of roadmaps."""
