"""The search for better values of options, shown on seeds that the search has not had."""
