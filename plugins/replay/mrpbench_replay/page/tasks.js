// Tasks that come over time: who does which, and how far each is, at any moment; their places on the map.

import { decoded, lastAtMost } from "replay/data.js";

const [RELEASED, REFUSED, ASSIGNED, WITHDRAWN, BEGUN, ERRAND, DONE, GIVEN_UP] = Array(8).keys(); // `TASK_EVENTS`
const FATES = { [REFUSED]: "refused", [DONE]: "done", [GIVEN_UP]: "given up" };
const SIDE = 9; // pixels of a mark
const NAMED = 3; // places of an errand that are named
const MANY = 60; // open tasks from which ages are not written

export class Tasks {
  constructor(run) {
    const { arrays } = run;
    this.run = run;
    this.x = decoded(arrays.errand_x);
    this.y = decoded(arrays.errand_y);
    this.level = arrays.errand_level.values;
    this.first = arrays.errand_first.values;
    this.number = arrays.errand_number.values;
    this.count = this.first.length - 1;
    this.times = decoded(arrays.task_time);
    this.kinds = arrays.task_kind.values;
    this.indices = arrays.task_index.values;
    this.robots = arrays.task_robot.values;
    this.errands = arrays.task_errand.values;
    this.doneTimes = this.times.filter((_, event) => this.kinds[event] === DONE);
    this.#restart();
  }

  #restart() {
    this.next = 0; // the first event that is not yet applied
    this.open = new Map(); // by task: when released, its robot or -1, errands done, and whether it has begun
    this.over = []; // tasks that have ended, with their fate, robot and time
    this.target = new Int32Array(this.run.count).fill(-1); // the task that each robot does or goes to do
  }

  /** Apply all events up to the time of the run; a time before the last one begins anew. */
  refresh() {
    const { run, times } = this;
    const before = this.next;
    if (this.next && times[this.next - 1] > run.now + 5e-4) this.#restart();
    while (this.next < times.length && times[this.next] <= run.now + 5e-4) this.#apply(this.next++);
    if (this.next !== before) this.#aim();
  }

  #apply(event) {
    const [index, kind, time] = [this.indices[event], this.kinds[event], this.times[event]];
    if (kind === RELEASED) this.open.set(index, { index, since: time, robot: -1, errand: 0, begun: false });
    const task = this.open.get(index);
    if (!task) return;
    if (kind === ASSIGNED) task.robot = this.robots[event];
    else if (kind === WITHDRAWN && task.robot === this.robots[event]) task.robot = -1;
    else if (kind === BEGUN) [task.begun, task.robot] = [true, this.robots[event]];
    else if (kind === ERRAND) [task.errand, task.begun] = [this.errands[event] + 1, true];
    if (!FATES[kind]) return;
    this.open.delete(index);
    this.over.push({ ...task, fate: FATES[kind], at: time });
  }

  /** A robot goes on with the task that it has begun; of several others, with the one that was released first. */
  #aim() {
    this.target.fill(-1);
    for (const { index, robot, begun } of this.open.values()) {
      if (robot >= 0 && (begun || this.target[robot] < 0)) this.target[robot] = index;
    }
  }

  get carried() {
    let count = 0;
    for (const task of this.open.values()) count += task.begun;
    return count;
  }

  get done() {
    return lastAtMost(this.doneTimes, this.run.now + 5e-4) + 1;
  }

  /** Number of errands of a task. */
  errandsOf(index) {
    return this.number[this.first[index + 1] - 1] + 1;
  }

  /** Indices of the places of the errand that comes next in a task, of which any will do. */
  places({ index, errand }) {
    const next = Math.min(errand, this.errandsOf(index) - 1);
    const found = [];
    for (let place = this.first[index]; place < this.first[index + 1]; place++) if (this.number[place] === next) found.push(place);
    return found;
  }

  /** Index of the place to which a robot goes now, -1 without a task: of several, the nearest to the end of its route. */
  goal(robot) {
    const task = this.open.get(this.target[robot]);
    if (!task) return -1;
    const { routeX, routeY, routeLevel, routeFirst } = this.run;
    const last = routeFirst[robot + 1] - 1;
    const gap = (place) =>
      Math.hypot(this.x[place] - routeX[last], this.y[place] - routeY[last]) + (this.level[place] === routeLevel[last] ? 0 : 1e6);
    return this.places(task).reduce((best, place) => (gap(place) < gap(best) ? place : best));
  }

  /** Names of the places of the errand that comes next in a task. */
  where(task) {
    const places = this.places(task);
    return places.length > NAMED ? `any of ${places.length} places` : places.map((place) => this.placeName(place)).join(" or ");
  }

  /** Name of a place, else metres. */
  placeName(place) {
    const [x, y, level] = [this.x[place], this.y[place], this.level[place]];
    const near = ([vx, vy, vl, name]) => name && vl === level && Math.hypot(vx - x, vy - y) < 0.01;
    const vertex = this.run.world.vertices.find(near);
    return vertex ? vertex[3].replaceAll("_", " ") : `${x.toFixed(2)}, ${y.toFixed(2)} m`;
  }

  /** Squares where tasks wait, with their ages in seconds; filled squares on the robots that carry one. */
  draw(context, view, theme, shown) {
    const [waiting, carried] = [new Path2D(), new Path2D()];
    const ages = this.open.size <= MANY;
    context.font = "11px system-ui, sans-serif";
    [context.textAlign, context.textBaseline, context.lineWidth] = ["left", "middle", 3];
    [context.strokeStyle, context.fillStyle] = [theme.paper, theme.ink];
    for (const task of this.open.values()) {
      for (const [x, y, level] of this.#where(task)) {
        if (level !== shown.level) continue;
        const [px, py] = view.toScreen(x, y);
        (task.begun ? carried : waiting).rect(px - SIDE / 2, py - SIDE / 2, SIDE, SIDE);
        if (task.begun || !ages) continue;
        const text = `${Math.floor(this.run.now - task.since)} s`;
        context.strokeText(text, px + SIDE, py);
        context.fillText(text, px + SIDE, py);
      }
    }
    context.fillStyle = theme.paper;
    context.fill(waiting);
    context.fillStyle = theme.accent;
    context.fill(carried);
    [context.strokeStyle, context.lineWidth] = [theme.accent, 2];
    context.stroke(waiting);
    [context.strokeStyle, context.lineWidth] = [theme.paper, 1];
    context.stroke(carried);
  }

  #where(task) {
    if (task.begun) return [[this.run.pose.x[task.robot], this.run.pose.y[task.robot], this.run.value("level", task.robot, 0)]];
    return this.places(task).map((place) => [this.x[place], this.y[place], this.level[place]]);
  }
}
