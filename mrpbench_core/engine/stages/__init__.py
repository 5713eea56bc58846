"""The stages of one run, in this order: prepare, assign, plan, judge, execute, export, measure."""
