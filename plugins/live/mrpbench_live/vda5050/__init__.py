"""Vehicles that speak VDA 5050, the interface between fleet controls and vehicles of the VDA and the VDMA.

From the bottom up: `names` has what differs between versions 2.1 and 3.0, `schemas` checks the fields of
messages, `orders` decides which orders are accepted, `actions` which actions run, `track` is the path of
a vehicle, `zones`, `corridors` and `bounds` say where it may be, `errors` has what it reports, `vehicle` and `instant`
are one vehicle, `download` what it fetches, `messages` what it says, `wire` its connection over MQTT, and `interface`
the fleet.

Sources: VDA 5050, versions 2.1.0 (2024) and 3.0.0 (2026), https://github.com/VDA5050/VDA5050.
"""
