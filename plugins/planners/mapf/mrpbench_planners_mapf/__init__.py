"""Native planners: `astar` (each robot alone), `prioritized` (SIPP) and `cbs` (optimal)."""
