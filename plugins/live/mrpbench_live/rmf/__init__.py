"""The next generation of Open-RMF over DDS, without ROS.

`robots` has the fleet of a run as robots for an outside plan server and plan executor; `traffic` has the planner and
the dispatcher of a run as plan server and plan executor for outside robots. Both stand on `wire`, the topics, and
`messages`, the types, which `definitions.txt` lists.

The interface is a prototype, described in `discourse/2-traffic-management-interfaces.md` and in the comments of its
messages: https://github.com/open-rmf/next_gen_prototype, as of 2026-05.
"""
