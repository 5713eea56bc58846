"""Crowds whose movers follow tracks: `scripted` and `dynabarn`."""
