"""Recoveries of robots that are stuck, with the names and values of Nav2's behaviours."""
