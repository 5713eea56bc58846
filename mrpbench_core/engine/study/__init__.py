"""Studies: selects the runs to execute, distributes them to workers and stores their records."""
