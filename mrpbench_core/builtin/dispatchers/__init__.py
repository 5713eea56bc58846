"""Dispatchers release a plan to robots that do not keep its times.

`adg`, `timed` and `all_at_once`. What `adg` shares with dispatchers in plugins is in `mrpbench_core.dispatching`.
"""
