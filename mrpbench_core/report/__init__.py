"""Reports, tables and figures.

`reading` turns results folders into columns of numbers. `estimation` groups the runs and compares the groups with the
methods in `statistics`. `tables` arranges the numbers. `report` does all of this once, and `html` and `data` write its
numbers. `folder_comparison` compares two folders. `pictures` show single runs.
"""
