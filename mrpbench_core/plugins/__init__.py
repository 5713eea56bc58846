"""Registry of components, guarded hooks, provenance, local plugins."""
