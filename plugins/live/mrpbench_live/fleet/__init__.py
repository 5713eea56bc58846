"""What all protocols share: fleet state out, orders in, events.

From the top down: `components` has the planner, the dispatcher and the task source `live`, `interface` the contract of
an interface, `transports` what the outside party has to serve under a load, `steps` its rates, `plans` the paths as
plans, `paths` what the outside party wants of each robot, `site` where it is, and `pace` the clock.
"""
