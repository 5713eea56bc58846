"""What tests of this repository share and authors of plugins do not need: see the folders."""
