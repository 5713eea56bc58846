"""Estimates and tests, by SciPy and statsmodels: each rule in one place. They see numbers, nothing of runs.

SciPy and statsmodels take seconds to import, so functions import them when they are called.
"""
