"""Files of the League of Robot Runners: problems and outputs."""
