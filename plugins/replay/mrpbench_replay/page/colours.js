// Which colour a robot has: its own, or that of what it is doing. Robots of the same colour have different rims.

import { COLOURS } from "replay/theme.js";

/** How rims are drawn, [colour, width, dash] of each of their lines; the first robots have none. */
export const RIMS = [[], [["ink", 2, []]], [["ink", 2, [2, 2.5]]], [["ink", 4, []], ["paper", 1.5, []]]];

export function coloursOf(run, theme, shown) {
  return shown.colour === "robot"
    ? { palette: theme.robot, of: (robot) => robot % COLOURS, rim: (robot) => Math.floor(robot / COLOURS) % RIMS.length }
    : { palette: theme.state, of: (robot) => run.state(robot), rim: () => 0 };
}
