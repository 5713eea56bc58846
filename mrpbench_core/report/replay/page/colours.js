// Which colour a robot has: its own, or that of what it is doing.

import { COLOURS } from "replay/theme.js";

export function coloursOf(run, theme, shown) {
  return shown.colour === "robot"
    ? { palette: theme.robot, of: (robot) => robot % COLOURS }
    : { palette: theme.state, of: (robot) => run.state(robot) };
}
