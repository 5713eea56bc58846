"""Dispatchers release a plan to robots that do not keep its times.

`adg`, `timed` and `all_at_once` are the dispatchers. `adg` builds a `dependency_graph` of moves from their type-2
edges, `rotations` and the occupations of resources (see `mrpbench_core.model`), and requests resources by
`resource_requests`.
"""
