// The time line: states of robots, contacts, events and the current time. A range input covers it.

import { clockText, timeStep } from "replay/clock.js";
import { lastAtMost } from "replay/data.js";
import { drawMark, markOf, MARKS, ROW } from "replay/marks.js";
import { STATES } from "replay/run.js";
import { fitCanvas } from "replay/surface.js";

const ORDER = [5, 0, 1, 2, 3, 4]; // from the bottom of the stack
const TICKS = 16; // pixels for the labels of the axis
const EDGE = 6; // pixels left and right, so that the ends can be seen

export class Timeline {
  constructor(run, canvas) {
    this.run = run;
    this.canvas = canvas;
    this.still = document.createElement("canvas");
    const kinds = [...run.events.map(([, kind]) => kind), ...(run.contacts.length ? ["contact"] : [])];
    this.rows = [...new Set(kinds.map((kind) => markOf(kind).row))].sort(); // those that have marks
    this.above = ROW * Math.max(this.rows.length, 1);
    canvas.parentElement.style.setProperty("--above", `${this.above}px`);
  }

  /** Pixel of a time. */
  x(time) {
    const { begin, end } = this.run;
    const width = this.canvas.clientWidth - 2 * EDGE;
    return EDGE + (end > begin ? ((time - begin) / (end - begin)) * width : 0);
  }

  /** Time of a pixel. */
  time(x) {
    const { begin, end } = this.run;
    const share = (x - EDGE) / (this.canvas.clientWidth - 2 * EDGE);
    return begin + Math.min(Math.max(share, 0), 1) * (end - begin);
  }

  /** Draw all but the play head. */
  prepare(theme) {
    const context = fitCanvas(this.canvas);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    context.clearRect(0, 0, width, height);
    const top = this.above;
    const bottom = height - TICKS;
    this.#drawStates(context, theme, top, bottom);
    this.#drawAxis(context, theme, width, bottom);
    this.#drawMarks(context, theme);
    this.still.width = this.canvas.width;
    this.still.height = this.canvas.height;
    this.still.getContext("2d").drawImage(this.canvas, 0, 0);
  }

  #drawStates(context, theme, top, bottom) {
    const { run } = this;
    const width = Math.max(Math.floor(this.x(run.end) - this.x(run.begin)), 1);
    const share = (bottom - top) / Math.max(run.count, 1);
    const counts = new Uint32Array(STATES.length);
    for (let column = 0; column < width; column++) {
      const sample = Math.max(lastAtMost(run.time, this.time(EDGE + column)), 0);
      counts.fill(0);
      for (let robot = 0; robot < run.count; robot++) counts[run.state(robot, sample)]++;
      let y = bottom;
      for (const state of ORDER) {
        if (!counts[state]) continue;
        context.fillStyle = theme.state[state];
        context.fillRect(EDGE + column, y - counts[state] * share, 1, counts[state] * share);
        y -= counts[state] * share;
      }
    }
  }

  #drawAxis(context, theme, width, bottom) {
    const { begin, end } = this.run;
    const step = timeStep(begin, end, width);
    context.fillStyle = theme.muted;
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "bottom";
    for (let time = Math.ceil(begin / step) * step; time <= end; time += step) {
      const x = this.x(time);
      context.fillRect(Math.round(x), bottom, 1, 4);
      const text = clockText(time).replace(/\.\d$/, "");
      const half = context.measureText(text).width / 2;
      context.textAlign = "center";
      context.fillText(text, Math.min(Math.max(x, half + 1), width - half - 1), bottom + TICKS);
    }
  }

  #drawMarks(context, theme) {
    const { run } = this;
    const order = (kind) => MARKS.indexOf(markOf(kind));
    const top = (kind) => ROW * this.rows.indexOf(markOf(kind).row);
    const events = run.events.toSorted((left, right) => order(left[1]) - order(right[1]));
    for (const [time, kind] of events) drawMark(context, theme, kind, this.x(time), top(kind));
    for (const [first, last] of run.contacts) {
      drawMark(context, theme, "contact", this.x(first), top("contact"));
      context.fillRect(this.x(first), top("contact") + 4, this.x(last) - this.x(first), 4);
    }
  }

  draw(theme) {
    const context = this.canvas.getContext("2d");
    const { clientWidth: width, clientHeight: height } = this.canvas;
    context.clearRect(0, 0, width, height);
    context.drawImage(this.still, 0, 0, width, height);
    const x = this.x(this.run.now);
    context.fillStyle = theme.paper;
    context.globalAlpha = 0.45;
    context.fillRect(x, this.above, this.x(this.run.end) - x, height - TICKS - this.above);
    context.globalAlpha = 1;
    context.fillStyle = theme.ink;
    context.fillRect(x - 1, 2, 2, height - TICKS - 1);
    context.beginPath();
    context.arc(x, 5, 5, 0, 2 * Math.PI);
    context.fill();
  }
}
