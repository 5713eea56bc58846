"""What simulators of rigid bodies share: the scene of a world, robots as bodies, drives, lidars and contacts."""
