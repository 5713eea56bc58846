"""Sources of starts and goals that need only the core's dependencies."""
