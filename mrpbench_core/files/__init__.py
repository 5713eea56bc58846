"""Strict YAML 1.2 with line marks, JSON lines, and the one exception for a user's mistake."""
