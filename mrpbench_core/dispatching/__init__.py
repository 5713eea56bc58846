"""What dispatchers that keep an order of robots share, so that plugins need not repeat it.

A `dependency_graph` of moves has the type-2 edges of an order (see `mrpbench_core.model.planning.type2_edges`), groups
of moves that start together (`rotations`), and requests for resources (`resource_requests`).
"""
