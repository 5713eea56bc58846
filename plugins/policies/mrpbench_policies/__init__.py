"""Learned policies: planners that ask one, the observations that it gets, and environments to train it in."""
