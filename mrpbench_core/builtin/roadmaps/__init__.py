"""Roadmaps: rasters of the free space or of the lanes, and the navigation graph itself."""
