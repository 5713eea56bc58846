"""Judges runs: a verdict is a function of the instance and the recording of a run, and of nothing else.

Runs, verified bundles, recordings of real fleets and solutions of others are judged here and nowhere else. Nothing here
imports or calls a component that is judged; what it said is a claim beside the verdict.
"""
