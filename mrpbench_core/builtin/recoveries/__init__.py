"""What robots try when they do not get on, by the names and values of Nav2's behaviours."""
