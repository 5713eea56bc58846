"""The parts of a traffic editor file (`building.yaml`), one file each."""
