"""From a YAML file to runs: structuring, matrix, defaults, JSON Schema, identity."""
