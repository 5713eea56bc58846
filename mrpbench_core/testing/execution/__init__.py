"""Executes plans on the roadmap alone, with delays."""
