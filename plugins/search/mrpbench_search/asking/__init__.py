"""Runs that a question asks for: done if they have no record, within a budget."""
