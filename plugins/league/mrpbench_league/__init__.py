"""The League of Robot Runners (LoRR, https://www.leagueofrobotrunners.org): its problems, executions and outputs.

- `files`: problems and outputs.
- `execute`: executes a problem in C++.
- `scoring`: scores an output from its motion alone.
- `scenario`, `task_source`, `simulator`, `planner`: what studies use.
- `commands`: what this distribution adds to `mrpbench`.

This file imports nothing, so that `mrpbench --help` does not import NumPy.
"""
