"""Makes the instance of a run: world, fleet, roadmap, scenario, assignment, and the first problem."""
