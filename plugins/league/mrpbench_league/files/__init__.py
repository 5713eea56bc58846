"""Files of the League of Robot Runners (LoRR, https://www.leagueofrobotrunners.org): problems and outputs."""
