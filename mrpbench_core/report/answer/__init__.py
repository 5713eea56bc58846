"""The answer at the beginning of a report: questions, rankings of the configurations, and sentences."""
