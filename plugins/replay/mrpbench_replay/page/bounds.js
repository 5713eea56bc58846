// The rectangle that holds everything of a run.

import { decoded } from "replay/data.js";

/** Left, bottom, right, top of everything, with a margin, metres. */
export function boundsOf({ arrays, world, routeX, routeY }) {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  const include = (x, y) => {
    [left, right] = [Math.min(left, x), Math.max(right, x)];
    [bottom, top] = [Math.min(bottom, y), Math.max(top, y)];
  };
  world.levels.forEach(({ raster, obstacles, floors }, number) => {
    const walls = decoded(arrays[`walls_${number}`]);
    for (let i = 0; i < walls.length; i += 2) include(walls[i], walls[i + 1]);
    for (const polygon of [...floors, ...obstacles.map((obstacle) => obstacle[1])]) polygon.forEach(([x, y]) => include(x, y));
    if (!raster) return;
    const [rows, columns] = arrays[`blocked_${number}`].shape;
    include(...raster.origin);
    include(raster.origin[0] + columns * raster.cell, raster.origin[1] + rows * raster.cell);
  });
  for (const [x, y] of world.vertices) include(x, y);
  for (let i = 0; i < routeX.length; i++) include(routeX[i], routeY[i]);
  if (left > right) include(0, 0);
  const margin = 0.015 * Math.max(right - left, top - bottom) + 0.2;
  return [left - margin, bottom - margin, right + margin, top + margin];
}
