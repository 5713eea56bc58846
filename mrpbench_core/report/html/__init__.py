"""The page of a report: one HTML file that loads nothing. Only its list of runs needs a script."""
