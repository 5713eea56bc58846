"""The checks of a bundle, one file for each kind of evidence."""
