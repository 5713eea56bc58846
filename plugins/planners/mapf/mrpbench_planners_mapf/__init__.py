"""Native planners: `astar` (each robot alone), `prioritized` (SIPP), `cbs` (optimal), `ecbs` and `eecbs` (bounded)."""
