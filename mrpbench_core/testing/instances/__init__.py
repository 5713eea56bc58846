"""Problems to plan: named ones, and ones drawn at random."""
