"""Worlds: walls, doors, lifts and floors."""
