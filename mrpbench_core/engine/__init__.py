"""Executes runs, in layers of which each uses those after it:

- `study`: which runs of a study are to be done, and what is kept of each;
- `processes`: the worker processes that execute runs, and their limits;
- `pipeline`: one run, stage after stage;
- `stages`: prepare, assign, plan, judge, execute, export, measure;
- `execution`: the loop that executes a plan.
"""
