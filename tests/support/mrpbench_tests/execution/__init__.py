"""Executes drawn plans and tasks on the roadmap alone, with delays."""
