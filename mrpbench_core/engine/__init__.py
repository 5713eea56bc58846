"""Executes runs. One run reads from top to bottom in `run`; its steps are folders, in the order of a run:

- `prepare`: world, roadmap, scenario, assignment and first problem become an instance, stored by its content;
- `drive`: plans, executes and exports with the plugins of the run, and writes the recording and what is claimed;
- `execution`: the loop that executes a plan, control period by control period, as `drive` uses it;
- `judging`: the record of a run from the verdict of `mrpbench_core.referee`.

Around runs:

- `processes`: the processes in which the steps happen, and their limits;
- `study`: which runs of a study are to be done, and what is kept of each;
- `loading`: the runs of a study as plain data.
"""
