"""Native planners: decentralised, prioritised, optimal, bounded and anytime; one module for each."""
