"""The benchmark of POGEMA inside mrpbench: its maps and lists of starts and goals, and its metrics."""
