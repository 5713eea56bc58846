"""Plan filters: what is left out of a plan before robots drive it."""
