"""Read what a user writes on the command line: arguments, plugins, runs and worlds."""
