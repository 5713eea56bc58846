// The tab of tasks: how many wait, are carried and are done, a curve of the throughput, and the list.

import { clockText } from "replay/clock.js";
import { lastAtMost } from "replay/data.js";
import { List, make } from "replay/list.js";
import { fitCanvas } from "replay/surface.js";

const WINDOWS = [10, 60, 300, 600, 3600]; // seconds over which the throughput is taken
const PARTS = 5; // such windows in a run at least
const LABEL = 14; // pixels above the curve

export class TaskPanel {
  /** `choose(robot)` is called when a task that has a robot is pressed. */
  constructor(run, choose) {
    this.run = run;
    this.tasks = run.tasks;
    if (!run.tasks) return;
    const length = run.end - run.begin;
    this.window = WINDOWS.findLast((window) => window * PARTS <= length) ?? Math.max(Math.round(length / PARTS), 1);
    this.canvas = document.querySelector("#throughput canvas");
    this.note = document.querySelector("#throughput p");
    this.list = new List(
      document.getElementById("task-list"),
      34,
      (button, task) => this.#fill(button, task),
      ({ robot }) => robot >= 0 && choose(robot),
      "No task was released yet.",
    );
  }

  /** Tasks done per hour, over the window that ends at a time; NaN in the first window, in which too little is known. */
  rate(time) {
    const { doneTimes } = this.tasks;
    const from = time - this.window;
    if (from < this.run.begin - 1e-9) return NaN;
    return ((lastAtMost(doneTimes, time + 5e-4) - lastAtMost(doneTimes, from + 5e-4)) * 3600) / this.window;
  }

  refresh(theme) {
    if (!this.tasks || !this.canvas.clientWidth) return;
    const { open, over, carried, done } = this.tasks;
    this.note.textContent = `${open.size - carried} waiting, ${carried} carried, ${done} done`;
    this.list.show([...open.values(), ...over.toReversed()]);
    this.#draw(theme);
  }

  #draw(theme) {
    const { run } = this;
    const context = fitCanvas(this.canvas);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const span = Math.max(run.end - run.begin, 1e-9);
    const x = (time) => ((time - run.begin) / span) * (width - 1);
    const rates = Array.from({ length: width }, (_, column) => this.rate(run.begin + (column / Math.max(width - 1, 1)) * span));
    const known = rates.filter((rate) => !Number.isNaN(rate));
    const most = Math.max(...known, 1);
    const now = this.rate(run.now);
    const y = (rate) => height - 1 - (rate / most) * (height - LABEL - 3);
    context.clearRect(0, 0, width, height);
    context.fillStyle = theme.muted;
    context.font = "11px system-ui, sans-serif";
    [context.textBaseline, context.textAlign] = ["top", "left"];
    const last = this.window < 120 ? `${this.window} s` : `${this.window / 60} min`;
    context.fillText(`done per hour, over ${last}; now ${Number.isNaN(now) ? "–" : Math.round(now)}, most ${Math.round(most)}`, 0, 0);
    context.strokeStyle = theme.rule;
    context.lineWidth = 1;
    context.strokeRect(0.5, LABEL + 0.5, width - 1, height - LABEL - 1);
    context.strokeStyle = theme.accent;
    context.lineWidth = 1.75;
    context.beginPath();
    for (let column = width - known.length; column < width; column++) context.lineTo(column, y(rates[column]));
    context.stroke();
    context.fillStyle = theme.ink;
    context.fillRect(x(run.now) - 0.5, LABEL, 1.5, height - LABEL);
  }

  #fill(button, task) {
    const { run, tasks } = this;
    const of = tasks.errandsOf(task.index);
    const name = task.robot >= 0 ? run.names[task.robot] : "";
    const where = tasks.where(task);
    const what = task.fate
      ? `${task.fate} after ${Math.round(task.at - task.since)} s`
      : `${task.begun ? "carried to" : "waits at"} ${where}`;
    const errand = task.begun && !task.fate && of > 1 ? `, errand ${task.errand + 1} of ${of}` : "";
    button.className = "event";
    button.title = `task ${task.index}, released at ${clockText(task.since)}: ${what}${errand}`;
    button.replaceChildren(make("time", "", String(task.index)), make("span", "what", what), make("span", "actor", name));
    button.classList.toggle("past", !task.fate);
  }
}
