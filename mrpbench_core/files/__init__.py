"""File formats: strict YAML 1.2 with line marks, JSON lines, URDF, rasters, and the error for the user."""
