"""New plugins: the names that follow from kind and name, and the files of a distribution."""
