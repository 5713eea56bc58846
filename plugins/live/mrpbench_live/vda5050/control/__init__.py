"""A fleet control: the run's planner and dispatcher decide, and foreign vehicles get orders of VDA 5050.

From the top down: `components` has the simulator and the navigator `vda5050`, `fleet` the connection with all vehicles,
`sender` the orders of one vehicle, `vehicle` what is known of it, `itinerary` its route as nodes, and `overlaps` which
robots touch.
"""
