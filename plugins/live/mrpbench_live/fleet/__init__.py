"""What all protocols share: fleet state out, orders in, events.

From the top down: `components` has the planner, the dispatcher and the task source `live`, `interface` the contract of
an interface, `plans` the paths as plans, `paths` what the outside party wants of each robot, `site` where it is, and
`pace` the clock.
"""
