// Heat map of waiting: robot-seconds of the whole run during which robots stood at a place and had not arrived.

import { STATES } from "replay/run.js";

const LEAST = 0.4; // side of a cell at least, metres
const CELLS = 160; // along the longer side of the world at most
const [WAITING, RECOVERING] = [STATES.indexOf("waiting"), STATES.indexOf("recovering")];

export class Heat {
  constructor(run, bounds) {
    this.run = run;
    this.bounds = bounds;
    const [left, bottom, right, top] = bounds;
    this.cell = Math.max(LEAST, Math.max(right - left, top - bottom) / CELLS);
    this.columns = Math.ceil((right - left) / this.cell);
    this.rows = Math.ceil((top - bottom) / this.cell);
    this.seconds = null; // by level, once asked for
    this.pictures = new Map();
  }

  /** Most robot-seconds of a cell. */
  get most() {
    this.seconds ??= this.#count();
    return this.seconds.reduce((most, cells) => cells.reduce((left, right) => Math.max(left, right), most), 0);
  }

  #count() {
    const { run, bounds, cell } = this;
    const found = run.world.levels.map(() => new Float32Array(this.rows * this.columns));
    const { x, y } = run.arrays;
    for (let robot = 0; robot < run.count; robot++) {
      for (let sample = 0; sample < run.samples - 1; sample++) {
        const state = run.state(robot, sample);
        if (state !== WAITING && state !== RECOVERING) continue;
        const at = robot * run.samples + sample;
        const column = Math.floor((x.offset + x.scale * x.values[at] - bounds[0]) / cell);
        const row = Math.floor((y.offset + y.scale * y.values[at] - bounds[1]) / cell);
        found[run.value("level", robot, 0, sample)][row * this.columns + column] += run.time[sample + 1] - run.time[sample];
      }
    }
    return found;
  }

  /** The picture of a level, one pixel per cell; its row 0 is the highest. */
  #picture(level, colour) {
    const key = `${level} ${colour}`;
    if (this.pictures.has(key)) return this.pictures.get(key);
    const most = this.most;
    const canvas = Object.assign(document.createElement("canvas"), { width: this.columns, height: this.rows });
    const context = canvas.getContext("2d");
    context.fillStyle = colour;
    this.seconds[level].forEach((seconds, index) => {
      if (!seconds) return;
      context.globalAlpha = 0.15 + 0.75 * Math.sqrt(seconds / most);
      context.fillRect(index % this.columns, this.rows - 1 - Math.floor(index / this.columns), 1, 1);
    });
    this.pictures.set(key, canvas);
    return canvas;
  }

  draw(context, view, theme, shown) {
    const [left, bottom] = this.bounds;
    const [px, py] = view.toScreen(left, bottom + this.rows * this.cell);
    const picture = this.#picture(shown.level, theme.state[WAITING]);
    context.imageSmoothingEnabled = false;
    context.drawImage(picture, px, py, this.columns * this.cell * view.scale, this.rows * this.cell * view.scale);
  }

  /** What its darkest colour means. */
  get text() {
    if (!this.most) return "heat: no robot waits";
    return `heat: up to ${this.most.toPrecision(3)} robot-seconds of waiting per ${this.cell.toPrecision(2)} m cell`;
  }
}
