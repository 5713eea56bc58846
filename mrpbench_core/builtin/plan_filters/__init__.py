"""Plan filters remove waypoints from a plan before robots drive along it."""
