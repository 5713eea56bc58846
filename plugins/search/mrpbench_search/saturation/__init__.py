"""The saturation rate of a fleet."""
