"""Pictures of worlds and of the paths that robots planned and drove, by matplotlib."""
