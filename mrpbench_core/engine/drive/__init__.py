"""Plans and executes one run, with its plugins in this process, and writes its recording: plan, execute, export."""
