"""The fleet of a run as robots of Open-RMF: `interface` has the topics, `follower` one robot with its plan."""
