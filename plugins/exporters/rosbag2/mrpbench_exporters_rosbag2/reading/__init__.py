"""Reads bags of any fleet back."""
