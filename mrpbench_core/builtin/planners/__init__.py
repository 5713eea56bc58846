"""Planners that need only the core: they make others serve where these alone do not."""
