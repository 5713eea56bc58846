"""Solvers of mrpbench in C++. `mrpbench_native.mapf`: multi-agent path finding."""
