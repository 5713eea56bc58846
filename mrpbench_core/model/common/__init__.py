"""Arrays, units, geometry and robots: what all other data is made of."""
