"""Dispatchers: how a plan is released to robots that do not keep its times."""
