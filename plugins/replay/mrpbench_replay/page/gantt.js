// A Gantt chart: a row per robot, the plan in force above, the execution below. A press goes to that time.

import { clockText, timeStep } from "replay/clock.js";
import { decoded, lastAtMost } from "replay/data.js";
import { STATES } from "replay/run.js";
import { fitCanvas } from "replay/surface.js";

const ROW = 22; // pixels per robot
const BAR = 7; // pixels of each of its two bars
const AXIS = 18;
const NAMES = 108; // pixels left of the bars
const EDGE = 10; // pixels right of them
const [FOLLOWING, WAITING] = [STATES.indexOf("following"), STATES.indexOf("waiting")];

export class Gantt {
  /** `seek(time)` and `choose(robot)` are called when a row is pressed. */
  constructor(run, { seek, choose }) {
    this.run = run;
    this.box = document.getElementById("gantt");
    this.canvas = this.box.querySelector("canvas");
    this.still = document.createElement("canvas");
    this.planned = run.arrays.plan_end ? decoded(run.arrays.plan_end) : [];
    this.end = this.planned.reduce((latest, time) => Math.max(latest, time), run.end);
    const height = `${run.count * ROW + AXIS}px`;
    this.box.style.setProperty("--all", height);
    this.box.querySelector(".sizer").style.height = height;
    this.plan = 0; // number of the plan that is drawn
    this.stale = true;
    this.box.addEventListener("scroll", () => (this.stale = true));
    this.canvas.addEventListener("click", ({ offsetX, offsetY }) => {
      const robot = this.#rowAt(offsetY);
      if (robot >= 0) choose(robot);
      if (offsetX >= NAMES) seek(this.time(offsetX));
    });
    this.canvas.addEventListener("pointermove", ({ offsetX, offsetY }) => (this.canvas.title = this.#tip(offsetX, offsetY)));
  }

  get shown() {
    return !this.box.hidden;
  }

  show(on) {
    this.box.hidden = !on;
    this.stale = true;
  }

  #x(time) {
    const { begin } = this.run;
    return NAMES + ((time - begin) / Math.max(this.end - begin, 1e-9)) * (this.canvas.clientWidth - NAMES - EDGE);
  }

  /** Time of a pixel. */
  time(x) {
    const { begin } = this.run;
    return begin + ((x - NAMES) / Math.max(this.canvas.clientWidth - NAMES - EDGE, 1)) * (this.end - begin);
  }

  #rowAt(y) {
    const robot = Math.floor((y - AXIS + this.box.scrollTop) / ROW);
    return y >= AXIS && robot < this.run.count ? robot : -1;
  }

  #tip(x, y) {
    const { run } = this;
    const robot = this.#rowAt(y);
    if (robot < 0 || x < NAMES) return "";
    const time = this.time(x);
    const text = `${run.names[robot]} ${clockText(time)}`;
    if (time > run.end) return text;
    const sample = Math.max(lastAtMost(run.time, time), 0);
    return `${text}: ${run.doing(robot, sample)}`;
  }

  /** Bring a robot's row into sight. */
  reveal(robot) {
    const { box } = this;
    if (robot < 0 || !this.shown) return;
    const top = robot * ROW;
    if (top < box.scrollTop || top + ROW + AXIS > box.scrollTop + box.clientHeight) box.scrollTop = top - box.clientHeight / 2;
  }

  draw(theme, selected) {
    if (!this.shown) return;
    if (this.plan !== this.run.planNow) [this.plan, this.stale] = [this.run.planNow, true];
    const context = fitCanvas(this.canvas);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (this.stale) {
      context.clearRect(0, 0, width, height);
      this.#drawRows(context, theme, selected, width, height);
      this.#drawAxis(context, theme, width, height);
      Object.assign(this.still, { width: this.canvas.width, height: this.canvas.height });
      this.still.getContext("2d").drawImage(this.canvas, 0, 0);
      this.stale = false;
    } else {
      context.clearRect(0, 0, width, height);
      context.drawImage(this.still, 0, 0, width, height);
    }
    context.fillStyle = theme.ink;
    context.fillRect(this.#x(this.run.now) - 1, 0, 2, height);
  }

  #drawRows(context, theme, selected, width, height) {
    const { run } = this;
    const first = Math.floor(this.box.scrollTop / ROW);
    const last = Math.min(first + Math.ceil(height / ROW) + 1, run.count);
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.textAlign = "left";
    for (let robot = first; robot < last; robot++) {
      const top = AXIS + robot * ROW - this.box.scrollTop;
      if (robot === selected) {
        context.fillStyle = theme.hover;
        context.fillRect(0, top, width, ROW);
      }
      context.fillStyle = robot === selected ? theme.ink : theme.muted;
      context.fillText(fitted(context, run.names[robot], NAMES - 18), 12, top + ROW / 2);
      this.#drawPlan(context, theme, robot, top + (ROW - 2 * BAR) / 2 - 0.5);
      this.#drawExecution(context, theme, robot, top + ROW / 2 + 0.5);
    }
  }

  #drawPlan(context, theme, robot, top) {
    if (!this.planned.length) return;
    const { plan_first, plan_waits } = this.run.arrays;
    const row = this.plan * this.run.count + robot;
    let from = this.#x(this.run.begin);
    context.globalAlpha = 0.55;
    for (let i = plan_first.values[row]; i < plan_first.values[row + 1]; i++) {
      const to = this.#x(this.planned[i]);
      context.fillStyle = theme.state[plan_waits.values[i] ? WAITING : FOLLOWING];
      context.fillRect(from, top, to - from, BAR);
      from = to;
    }
    context.globalAlpha = 1;
  }

  #drawExecution(context, theme, robot, top) {
    const { run } = this;
    const end = Math.ceil(this.#x(run.end));
    let [from, before] = [NAMES, -1];
    for (let x = NAMES; x <= end; x++) {
      const state = x < end ? run.state(robot, Math.max(lastAtMost(run.time, this.time(x)), 0)) : -1;
      if (state === before) continue;
      if (before >= 0) {
        context.fillStyle = theme.state[before];
        context.fillRect(from, top, x - from, BAR);
      }
      [from, before] = [x, state];
    }
  }

  #drawAxis(context, theme, width, height) {
    context.fillStyle = theme.page;
    context.fillRect(0, 0, width, AXIS);
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = theme.muted;
    context.textAlign = "left";
    context.fillText("plan / driven", 12, AXIS / 2);
    context.textAlign = "center";
    const step = timeStep(this.run.begin, this.end, width - NAMES - EDGE);
    for (let time = Math.ceil(this.run.begin / step) * step; time <= this.end; time += step) {
      const text = clockText(time).replace(/\.\d$/, "");
      const half = context.measureText(text).width / 2;
      const x = this.#x(time);
      context.fillText(text, Math.min(x, width - half - 1), AXIS / 2);
      context.globalAlpha = 0.25;
      context.fillRect(Math.round(x), AXIS, 1, height);
      context.globalAlpha = 1;
    }
    this.#drawNewPlans(context, theme, height);
  }

  /** A dashed line where a new plan takes effect. */
  #drawNewPlans(context, theme, height) {
    context.strokeStyle = theme.ink;
    context.lineWidth = 1;
    context.setLineDash([3, 3]);
    context.beginPath();
    for (const time of this.run.planTime.subarray(1)) {
      const x = Math.round(this.#x(time)) + 0.5;
      context.moveTo(x, AXIS);
      context.lineTo(x, height);
    }
    context.stroke();
    context.setLineDash([]);
  }
}

/** A text shortened so that it fits. */
function fitted(context, text, width) {
  let short = text;
  while (short.length > 1 && context.measureText(short).width > width) short = `${short.slice(0, -2)}…`;
  return short;
}
