"""The commands `publish`, `verify` and `site`."""
