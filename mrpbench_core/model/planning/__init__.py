"""Roadmaps, scenarios, problems, plans, and the only definition of a conflict."""
