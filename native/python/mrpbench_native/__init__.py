"""Parts of mrpbench in C++. `mapf`: multi-agent path finding; `sim`: robots, contacts and lidars in the plane;
`amcl`: localisation; `local`: costmaps and local control.
"""
