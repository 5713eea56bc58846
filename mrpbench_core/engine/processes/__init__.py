"""Worker processes: each executes runs one after another, and is ended from outside when a run passes a limit."""
