"""What is true of a problem, and whether a planner's answer agrees."""
