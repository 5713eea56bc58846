// What controllers weighed: the trajectories that they sampled, and the one that they chose. Read when first shown.

import { decoded, lastAtMost, readArrays } from "replay/data.js";

const REFUSED = 255; // as in `trajectories.py`
const UNKNOWN = 254;
const RANKS = 250;
const SHADES = 10; // colours of costs
const FRESH = 0.12; // seconds for which a command is shown at least

export class Trajectories {
  constructor(run, recorded) {
    this.run = run;
    this.recorded = recorded;
    this.arrays = null;
    this.reading = null;
  }

  /** Read the trajectories, once. */
  read() {
    this.reading ??= readArrays("trajectories").then((arrays) => {
      this.time = decoded(arrays.trajectory_time);
      this.begin = this.#firstOf(arrays.trajectory_robot);
      this.fresh = Math.max(FRESH, 1.5 * this.#shortest());
      this.criticTime = arrays.critic_time ? decoded(arrays.critic_time) : new Float64Array();
      this.criticBegin = this.#firstOf(arrays.critic_robot ?? { values: [] });
      this.arrays = arrays;
    });
    return this.reading;
  }

  /** Where the rows of each robot begin, and where the last ones end. */
  #firstOf({ values }) {
    return Array.from({ length: this.run.count + 1 }, (_, robot) => lastAtMost(values, robot - 1) + 1);
  }

  /** The shortest time between two commands of a robot. */
  #shortest() {
    let least = Infinity;
    for (let i = 1; i < this.time.length; i++) {
      const gap = this.time[i] - this.time[i - 1];
      if (gap > 0) least = Math.min(least, gap);
    }
    return Number.isFinite(least) ? least : 0;
  }

  /** Index of the command of a robot that is in force, -1 if none was recorded. */
  moment(robot) {
    if (!this.arrays || robot < 0) return -1;
    const [first, end] = [this.begin[robot], this.begin[robot + 1]];
    const at = lastAtMost(this.time, this.run.now + 1e-6, first, end);
    return at < first || this.run.now - this.time[at] > this.fresh ? -1 : at;
  }

  /** What each critic adds to the cost of the chosen trajectory of a robot: [name, score], in the order of the critics. */
  scores(robot) {
    const at = this.moment(robot);
    if (at < 0 || !this.arrays.critic_name) return [];
    const [first, end] = [this.criticBegin[robot], this.criticBegin[robot + 1]];
    const found = [];
    const { values, scale, offset } = this.arrays.critic_score;
    for (let i = lastAtMost(this.criticTime, this.time[at] + 5e-4, first, end); i >= first; i--) {
      if (this.criticTime[i] < this.time[at] - 5e-4) break;
      found.unshift([this.recorded.critics[this.arrays.critic_name.values[i]], offset + scale * values[i]]);
    }
    return found;
  }

  draw(context, view, theme, shown) {
    const { run, arrays } = this;
    const at = this.moment(shown.selected);
    if (at < 0 || run.value("level", shown.selected, 0) !== shown.level) return;
    const lines = Array.from({ length: SHADES }, () => new Path2D());
    const [refused, chosen] = [new Path2D(), new Path2D()];
    const { values: firsts } = arrays.trajectory_first;
    for (let row = firsts[at]; row < firsts[at + 1]; row++) {
      const rank = arrays.trajectory_rank.values[row];
      if (arrays.trajectory_chosen.values[row]) this.#line(chosen, view, row);
      else if (rank >= UNKNOWN) this.#line(refused, view, row);
      else this.#line(lines[Math.min(Math.floor((rank / RANKS) * SHADES), SHADES - 1)], view, row);
    }
    context.lineJoin = context.lineCap = "round";
    this.#stroke(context, refused, theme.muted, 0.8, 0.35, [2, 4]);
    for (let shade = SHADES - 1; shade >= 0; shade--) this.#stroke(context, lines[shade], shadeOf(shade), 1, 0.5);
    this.#stroke(context, chosen, theme.paper, 6, 0.9);
    this.#stroke(context, chosen, theme.ink, 3, 1);
  }

  #line(path, view, row) {
    const { trajectory_x: xs, trajectory_y: ys } = this.arrays;
    const count = xs.shape[1];
    for (let i = row * count; i < (row + 1) * count; i++) {
      const point = view.toScreen(xs.offset + xs.scale * xs.values[i], ys.offset + ys.scale * ys.values[i]);
      if (i === row * count) path.moveTo(...point);
      else path.lineTo(...point);
    }
  }

  #stroke(context, path, colour, width, alpha, dash = []) {
    context.setLineDash(dash);
    Object.assign(context, { strokeStyle: colour, lineWidth: width, globalAlpha: alpha });
    context.stroke(path);
    context.setLineDash([]);
    context.globalAlpha = 1;
  }
}

/** From blue, the lowest cost, to yellow. */
export function shadeOf(shade) {
  return `hsl(${Math.round(225 - (180 * shade) / (SHADES - 1))} 85% 48%)`;
}
