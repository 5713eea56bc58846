// The maps that robots build, read only when the reader switches them on: that of the chosen robot, or those of all.

import { decoded, lastAtMost, readArrays } from "replay/data.js";

const MOST = 20; // robots whose maps are shown together
const [FREE, OCCUPIED] = [0.16, 0.85]; // opacity

export class RobotMaps {
  constructor(run, packed) {
    this.run = run;
    this.packed = packed;
    this.arrays = null;
    this.reading = null;
    this.painted = new Map(); // by tile and colour
  }

  /** Read the maps, once. */
  read() {
    this.reading ??= readArrays("maps").then((arrays) => {
      this.time = decoded(arrays.map_time);
      this.arrays = arrays;
    });
    return this.reading;
  }

  /** The last tile of each place of a robot's map, as rows of the arrays. */
  tiles(robot) {
    const { map_robot, map_corner } = this.arrays;
    const found = new Map();
    const last = lastAtMost(this.time, this.run.now);
    for (let row = 0; row <= last; row++) {
      if (map_robot.values[row] === robot) found.set(`${map_corner.values[2 * row]} ${map_corner.values[2 * row + 1]}`, row);
    }
    return [...found.values()];
  }

  draw(context, view, theme, shown) {
    if (!this.arrays) return;
    const { run } = this;
    const all = run.count <= MOST ? run.count : 0;
    const robots = shown.selected >= 0 ? [shown.selected] : Array.from({ length: all }, (_, robot) => robot);
    context.imageSmoothingEnabled = false;
    for (const robot of robots) {
      if (run.value("level", robot, 0) !== shown.level) continue;
      for (const row of this.tiles(robot)) this.#drawTile(context, view, row, theme.robot[robot % theme.robot.length]);
    }
  }

  #drawTile(context, view, row, colour) {
    const { values, shape } = this.arrays.map_cells;
    const [column, line] = [0, 1].map((axis) => this.arrays.map_corner.values[2 * row + axis]);
    const { side } = this.packed;
    const [left, bottom] = view.toScreen(column * side, line * side);
    const [width, height] = [shape[2] * side * view.scale, shape[1] * side * view.scale];
    if (left > view.width || left + width < 0 || bottom < 0 || bottom - height > view.height) return;
    const key = `${row} ${colour}`;
    if (!this.painted.has(key)) this.painted.set(key, paintTile(values, row, shape, colour));
    context.drawImage(this.painted.get(key), left, bottom - height, width, height);
  }
}

/** A tile as a picture, one pixel per cell; its first row is the lowest. */
function paintTile(values, row, [, rows, columns], colour) {
  const tile = new OffscreenCanvas(columns, rows);
  const context = tile.getContext("2d");
  context.fillStyle = colour;
  for (let y = 0; y < rows; y++) {
    for (let x = 0; x < columns; x++) {
      const value = values[(row * rows + y) * columns + x];
      if (value === 0) continue;
      context.globalAlpha = value > 50 ? OCCUPIED : FREE;
      context.fillRect(x, rows - 1 - y, 1, 1);
    }
  }
  return tile;
}
