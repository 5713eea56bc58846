"""Dispatchers release a plan to robots that do not keep its times.

`adg`, `timed` and `all_at_once` are the dispatchers. `adg` builds a `dependency_graph` of moves from `type2_edges`,
`rotations` and the `occupations` of resources, and asks for the latter by `resource_requests`.
"""
