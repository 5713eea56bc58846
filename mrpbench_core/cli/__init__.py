"""The command line: one file per command, which calls the Python API; `input` and `output` hold what commands share."""
