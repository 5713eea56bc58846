"""Components that need only the core's dependencies; declared by entry points like any plugin."""
