"""Recordings of any fleet, measured as if mrpbench had made them; saturation of fleets; calibration of roadmaps."""
