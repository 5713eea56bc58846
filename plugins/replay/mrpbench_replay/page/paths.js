// Planned, driven and reserved paths.

import { lastAtMost } from "replay/data.js";

const TOLERANCE = 0.01; // metres that a simplified trail may leave the driven one
const TAIL = 20; // seconds of the trail that are drawn when all of many robots' are
const MANY = 100;

export class Paths {
  constructor(run) {
    this.run = run;
    this.trails = new Array(run.count);
  }

  /** The robots whose paths are drawn: the selected one, or all. */
  #each(shown, draw) {
    if (shown.selected >= 0) draw(shown.selected);
    else for (let robot = 0; robot < this.run.count; robot++) draw(robot);
  }

  draw(context, view, shown, colours) {
    context.lineJoin = context.lineCap = "round";
    if (shown.layers.reserved && this.run.arrays.released) this.#drawReserved(context, view, shown, colours);
    if (shown.layers.plan) this.#drawPlans(context, view, shown, colours);
    if (shown.layers.driven) this.#drawDriven(context, view, shown, colours);
  }

  #drawReserved(context, view, shown, colours) {
    const { run } = this;
    const bands = colours.palette.map(() => new Path2D());
    const used = new Set();
    const routes = run.routeNow;
    let radius = 0;
    for (let robot = 0; robot < run.count; robot++) {
      const reached = run.value("reached", robot, 0);
      const released = Math.min(run.value("released", robot, 0), routes[robot + 1] - routes[robot] - 1);
      if (released <= reached || run.value("level", robot, 0) !== shown.level || !run.isKnown(robot)) continue;
      const first = routes[robot];
      const band = bands[colours.of(robot)];
      band.moveTo(...view.toScreen(run.pose.x[robot], run.pose.y[robot]));
      for (let i = first + reached + 1; i <= first + released; i++) {
        band.lineTo(...view.toScreen(run.routeX[i], run.routeY[i]));
      }
      used.add(colours.of(robot));
      radius = Math.max(radius, run.model(robot).radius);
    }
    context.lineWidth = Math.max(2 * radius * view.scale, 4);
    if (run.count > MANY) [context.lineJoin, context.lineCap] = ["bevel", "butt"]; // round ones are slow
    context.globalAlpha = 0.25;
    for (const index of used) {
      context.strokeStyle = colours.palette[index];
      context.stroke(bands[index]);
    }
    context.lineJoin = context.lineCap = "round";
    context.globalAlpha = 1;
  }

  /** Only goals where no plan is known. Dotted; thin and faint where there are many, which dots would make slow. */
  #drawPlans(context, view, shown, colours) {
    const { run } = this;
    const crowd = run.count > MANY && shown.selected < 0;
    const routes = run.routeNow;
    const lines = colours.palette.map(() => new Path2D());
    const goals = colours.palette.map(() => new Path2D());
    this.#each(shown, (robot) => {
      const [first, end] = [routes[robot], routes[robot + 1]];
      const colour = colours.of(robot);
      for (let i = first; run.planned && i < end; i++) {
        const onward = i > first && run.routeLevel[i] === shown.level && run.routeLevel[i - 1] === shown.level;
        lines[colour][onward ? "lineTo" : "moveTo"](...view.toScreen(run.routeX[i], run.routeY[i]));
      }
      const [x, y, level] = this.#goal(robot, end - 1);
      if (level === shown.level) addGoal(goals[colour], ...view.toScreen(x, y), crowd ? 3 : 7);
    });
    colours.palette.forEach((colour, index) => {
      context.strokeStyle = colour;
      context.lineWidth = crowd ? 0.75 : 1.75;
      context.globalAlpha = crowd ? 0.6 : 1;
      context.setLineDash(crowd ? [] : [1, 5]);
      context.stroke(lines[index]);
      context.setLineDash([]);
      context.lineWidth = crowd ? 1 : 2;
      context.stroke(goals[index]);
    });
    context.globalAlpha = 1;
  }

  /** x, y and level of a robot's goal: a place of its task, else where its route ends; nothing without a task. */
  #goal(robot, last) {
    const { tasks, routeX, routeY, routeLevel } = this.run;
    if (!tasks) return [routeX[last], routeY[last], routeLevel[last]];
    const place = tasks.goal(robot);
    return place < 0 ? [] : [tasks.x[place], tasks.y[place], tasks.level[place]];
  }

  #drawDriven(context, view, shown, colours) {
    const { run } = this;
    const crowd = run.count > MANY && shown.selected < 0;
    const from = crowd ? lastAtMost(run.time, run.now - TAIL) : 0;
    const lines = colours.palette.map(() => new Path2D());
    const { x, y } = run.arrays;
    this.#each(shown, (robot) => {
      if (!run.isKnown(robot)) return;
      const trail = (this.trails[robot] ??= simplify(run, robot));
      const line = lines[colours.of(robot)];
      let pen = false;
      for (let i = Math.max(lastAtMost(trail, from), 0); i < trail.length && trail[i] <= run.latest; i++) {
        const sample = trail[i];
        if (run.value("level", robot, 0, sample) !== shown.level) {
          pen = false;
          continue;
        }
        const at = robot * run.samples + sample;
        const point = view.toScreen(x.offset + x.scale * x.values[at], y.offset + y.scale * y.values[at]);
        if (pen) line.lineTo(...point);
        else line.moveTo(...point);
        pen = true;
      }
      if (pen && run.value("level", robot, 0) === shown.level) {
        line.lineTo(...view.toScreen(run.pose.x[robot], run.pose.y[robot]));
      }
    });
    context.lineWidth = crowd ? 1.25 : 2;
    context.lineJoin = crowd ? "bevel" : "round";
    context.globalAlpha = crowd ? 1 : 0.85;
    lines.forEach((line, index) => {
      context.strokeStyle = colours.palette[index];
      context.stroke(line);
    });
    context.globalAlpha = 1;
  }
}

/** A target: ring and dot. */
function addGoal(path, x, y, radius) {
  path.moveTo(x + radius, y);
  path.arc(x, y, radius, 0, 2 * Math.PI);
  path.moveTo(x + 1, y);
  path.arc(x, y, 1, 0, 2 * Math.PI);
}

/** Samples of a robot's trail that suffice to draw it: a new one where the cone of allowed directions is left. */
function simplify(run, robot) {
  const { x, y } = run.arrays;
  const first = robot * run.samples;
  const kept = [0];
  let anchor = 0;
  let [low, high, farthest] = [-Math.PI, Math.PI, 0];
  let axis = 0;
  for (let i = 1; i < run.samples; i++) {
    const dx = (x.values[first + i] - x.values[first + anchor]) * x.scale;
    const dy = (y.values[first + i] - y.values[first + anchor]) * y.scale;
    const distance = Math.hypot(dx, dy);
    if (distance <= TOLERANCE && farthest <= TOLERANCE) continue;
    const spread = Math.asin(Math.min(1, TOLERANCE / Math.max(distance, TOLERANCE)));
    if (farthest <= TOLERANCE) axis = Math.atan2(dy, dx);
    const turn = Math.atan2(Math.sin(Math.atan2(dy, dx) - axis), Math.cos(Math.atan2(dy, dx) - axis));
    if (turn < low || turn > high || distance < farthest - TOLERANCE) {
      anchor = i - 1;
      kept.push(anchor);
      [low, high, farthest] = [-Math.PI, Math.PI, 0];
      i--; // judge this sample again from the new anchor
      continue;
    }
    [low, high] = [Math.max(low, turn - spread), Math.min(high, turn + spread)];
    farthest = Math.max(farthest, distance);
  }
  if (kept.at(-1) !== run.samples - 1) kept.push(run.samples - 1);
  return kept;
}
