"""Questions that are answered by a search over runs."""
