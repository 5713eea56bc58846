"""Which rules of VDA 5050 an outside party keeps: `vehicle` asks a vehicle, `control` listens to a fleet control."""
