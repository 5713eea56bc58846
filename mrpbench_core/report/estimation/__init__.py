"""Groups of comparable runs, estimates for each group, and comparisons of groups in pairs."""
