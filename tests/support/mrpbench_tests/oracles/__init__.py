"""Judges of answers of planners and of records of tasks."""
