"""Runs against a clock, in which an outside party decides where robots go, over the protocols of fleets.

`fleet` is what all protocols share: the paths that come from outside, the components that bring them into a run, and
the contract of an interface. `vda5050` has the vehicles of VDA 5050, and its rules.
"""
