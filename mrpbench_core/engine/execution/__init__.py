"""The execution of a plan: the loop and what takes part in it."""
