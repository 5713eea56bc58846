"""mrpbench: a benchmark for multi-robot planning, from task assignment to what the robots then do."""

__version__ = "0.1.0"
