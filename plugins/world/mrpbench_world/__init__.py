"""The command `world`: facts, faults and pictures of maps, and files of worlds and runs for other programs."""
