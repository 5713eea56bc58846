"""Estimates and tests, computed by SciPy and statsmodels. They know numbers only, no runs.

SciPy and statsmodels take seconds to import, so functions import them when they are called.
"""
