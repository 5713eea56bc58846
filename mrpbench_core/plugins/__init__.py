"""Find, load and check plugins; call hooks; record where plugins come from."""
