"""Problems, plans and buildings that are drawn at random."""
