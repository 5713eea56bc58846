"""Bundles of results: publishes them, and verifies those of others."""
