"""The page of a report: one HTML file that loads no other file. Only its list of runs needs a script."""
