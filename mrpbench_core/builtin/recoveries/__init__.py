"""What robots try when they are stuck, by the names and values of Nav2's behaviours."""
