"""The planner and the dispatcher of a run as plan server and plan executor of Open-RMF, for outside robots.

From the top down: `components` has the simulator, the navigator, the planner and the dispatcher `rmf`, `traffic` what
they share, `posting` plans as messages, `participants` what is known of the robots, and `destinations` where these are
to go.
"""
