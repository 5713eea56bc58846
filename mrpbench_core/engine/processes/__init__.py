"""Worker processes: each executes one run after another and is ended from outside when a run exceeds a limit."""
