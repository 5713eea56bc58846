"""Independent validators of plans, assignments, recordings and worlds."""
