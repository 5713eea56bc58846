"""A static site of published results: a page for each board and each bundle, and an index."""
