"""A study: which of its runs are to be done, and what is kept of each."""
