"""Sources of tasks that come over time."""
