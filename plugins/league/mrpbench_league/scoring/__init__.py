"""Scores outputs of the League of Robot Runners from their motion alone, and says where they break a rule.

Nothing here is shared with the simulation that writes such outputs.
"""
