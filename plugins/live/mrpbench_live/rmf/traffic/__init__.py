"""The planner and the dispatcher of a run as plan server and plan executor of Open-RMF, for outside robots.

From the top down: `simulator`, `navigator`, `planner` and `dispatcher` have the components `rmf`, `shared` and
`traffic` what they share, `composing` what a plan says and to whom it is new, `posting` plans as messages,
`participants` what is known of the robots, and `destinations` where these are to go.
"""
