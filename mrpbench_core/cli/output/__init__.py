"""Print tables, progress, summaries and plugins, and write replays."""
