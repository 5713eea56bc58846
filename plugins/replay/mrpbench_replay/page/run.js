// A recorded run: where every robot is at any time, interpolated between samples, and what it is doing.

import { decoded, lastAtMost } from "replay/data.js";
import { Tasks } from "replay/tasks.js";
import { Why } from "replay/why.js";

/** What a robot may be doing: `Mode` of the recording, then what follows from its progress. */
export const STATES = ["following", "waiting", "recovering", "off path", "aborted", "arrived"];
const WAITING = 1;
export const ABORTED = 4;
const ARRIVED = 5;

export class Run {
  constructor(data, arrays) {
    this.facts = data.facts;
    this.world = data.world;
    this.events = data.events;
    this.contacts = data.contacts;
    this.movers = data.movers;
    this.arrays = arrays;
    this.time = decoded(arrays.time);
    this.samples = this.time.length;
    this.begin = this.time[0];
    this.end = this.time[this.samples - 1];
    this.names = data.robots.names;
    this.goals = data.robots.goals;
    this.planned = data.robots.planned;
    this.count = this.names.length;
    this.models = data.robots.models;
    this.kind = arrays.kind.values;
    this.planTime = decoded(arrays.plan_time);
    const first = arrays.route_first.values;
    this.plans = Array.from(this.planTime, (_, plan) => first.subarray(plan * this.count, (plan + 1) * this.count + 1));
    this.planOf = Int32Array.from(this.time, (time) => Math.max(lastAtMost(this.planTime, time), 0));
    this.routeFirst = this.plans.at(-1); // of the last plan, which begins with all that was driven before
    this.routeX = decoded(arrays.route_x);
    this.routeY = decoded(arrays.route_y);
    this.lastMoves = arrays.route_last_move.values;
    this.routeLevel = arrays.route_level.values;
    this.now = this.begin;
    this.sample = 0;
    this.fraction = 0;
    this.pose = this.#poses();
    this.ghost = arrays.estimate_x ? this.#poses() : null;
    this.why = new Why(this);
    this.tasks = arrays.task_time ? new Tasks(this) : null;
    this.seek(this.begin);
  }

  #poses() {
    const make = () => new Float64Array(this.count);
    return { x: make(), y: make(), yaw: make() };
  }

  model(robot) {
    return this.models[this.kind[robot]];
  }

  /** Move to a time; fills `pose` (and `ghost`, where the robots believe to be). */
  seek(time) {
    this.now = Math.min(Math.max(time, this.begin), this.end);
    this.sample = Math.min(Math.max(lastAtMost(this.time, this.now), 0), Math.max(this.samples - 2, 0));
    const span = this.samples > 1 ? this.time[this.sample + 1] - this.time[this.sample] : 0;
    this.fraction = span > 0 ? (this.now - this.time[this.sample]) / span : 0;
    for (const axis of ["x", "y", "yaw"]) {
      this.#interpolate(this.arrays[axis], this.pose[axis]);
      if (this.ghost) this.#interpolate(this.arrays[`estimate_${axis}`], this.ghost[axis]);
    }
    this.tasks?.refresh();
  }

  /** Yaw was unwrapped when it was packed: halfway from 179° to -179° is 180°, not 0°. */
  #interpolate({ values, scale, offset }, into) {
    const step = this.samples > 1 ? 1 : 0;
    for (let robot = 0, at = this.sample; robot < this.count; robot++, at += this.samples) {
      into[robot] = offset + scale * (values[at] + this.fraction * (values[at + step] - values[at]));
    }
  }

  /** Value now of a row of an array that has a column per sample, between the samples around. */
  between({ values, scale, offset }, row) {
    const at = row * this.samples + this.sample;
    const next = at + (this.samples > 1 ? 1 : 0);
    return offset + scale * (values[at] + this.fraction * (values[next] - values[at]));
  }

  /** Name of what a robot touched: a robot, a mover, or -1 for a wall. */
  touchedName(other) {
    if (other < 0) return "wall";
    return other < this.count ? this.names[other] : this.movers[other - this.count]?.name ?? "mover";
  }

  /** The newest sample that is not in the future. */
  get latest() {
    return this.fraction >= 1 ? this.sample + 1 : this.sample;
  }

  /** Value of a counting channel now (or at a sample), `missing` if it was not recorded. */
  value(channel, robot, missing, sample = this.latest) {
    const array = this.arrays[channel];
    return array ? array.values[robot * this.samples + sample] : missing;
  }

  levelName(level) {
    return this.world.levels[level]?.name || `Level ${level}`;
  }

  isKnown(robot) {
    return this.value("known", robot, 1) === 1;
  }

  /** Number of the plan in force now. */
  get planNow() {
    return Math.max(lastAtMost(this.planTime, this.now), 0);
  }

  /** First waypoints of every robot's route by the plan in force now, and where the last one ends. */
  get routeNow() {
    return this.plans[this.planNow];
  }

  /** Number of path segments of a robot, by the plan of a sample. */
  segments(robot, sample = this.latest) {
    const routes = this.plans[this.planOf[sample]];
    return Math.max(routes[robot + 1] - routes[robot] - 1, 0);
  }

  /** Number of leading segments up to a robot's last move, by the plan of a sample. */
  lastMove(robot, sample = this.latest) {
    return this.lastMoves[this.planOf[sample] * this.count + robot] ?? 0;
  }

  state(robot, sample = this.latest) {
    const mode = this.value("mode", robot, 0, sample);
    if (mode === ABORTED || !this.arrays.reached) return mode;
    const over = this.value("reached", robot, 0, sample) >= this.lastMove(robot, sample);
    return over && mode <= WAITING ? ARRIVED : mode;
  }

  /** What a robot is doing now (or at a sample), in words: why it stands, else its state. */
  doing(robot, sample = this.latest) {
    return this.why.text(robot, sample) || STATES[this.state(robot, sample)];
  }

  /** Metres per second between the samples around now, of the robot's origin. */
  speed(robot) {
    if (this.samples < 2) return 0;
    const { x, y } = this.arrays;
    const at = robot * this.samples + this.sample;
    const dx = (x.values[at + 1] - x.values[at]) * x.scale;
    const dy = (y.values[at + 1] - y.values[at]) * y.scale;
    return Math.hypot(dx, dy) / (this.time[this.sample + 1] - this.time[this.sample]);
  }

  /** Robots of the contacts that last now or ended less than `after` seconds ago: [robot, other or -1, start]. */
  touching(after) {
    return this.contacts.filter(([first, last]) => first <= this.now && this.now <= last + after);
  }

  /** Where a robot goes: a place of its task, the name of its only goal, or metres. */
  goal(robot) {
    if (this.tasks) {
      const place = this.tasks.goal(robot);
      return place < 0 ? "–" : `${this.tasks.placeName(place)} (task ${this.tasks.target[robot]})`;
    }
    const last = this.routeFirst[robot + 1] - 1;
    if (last < this.routeFirst[robot]) return "–";
    const place = `${this.routeX[last].toFixed(2)}, ${this.routeY[last].toFixed(2)} m`;
    return this.goals[robot]?.replaceAll("_", " ") || place;
  }
}
