// Why robots stand: the reason in words, and a line to the culprit.

import { ABORTED } from "replay/run.js";

/** `Reason` of `waits.py`. */
export const REASONS = ["", "robot", "resource", "rotation", "replan", "recovery", "schedule", "start", "unknown", "blocked", "fault", "delay"];
const CROWD = 100; // robots above which lines are thin and without arrow heads, which would make pages slow
const HEAD = 9; // pixels of an arrow head
const WORDS = {
  replan: "waits for a new plan",
  schedule: "waits for its time in the plan",
  start: "starts late",
  unknown: "waits, reason not recorded",
  delay: "is stopped by a delay",
};

export class Why {
  constructor(run) {
    this.run = run;
  }

  /** Name of the reason why a robot stands now (or at a sample), "" if it does not. */
  reason(robot, sample = this.run.latest) {
    return REASONS[this.run.value("reason", robot, 0, sample)];
  }

  #culprit(robot, sample = this.run.latest) {
    return this.run.value("culprit", robot, -1, sample);
  }

  /** The reason in words, "" if the robot does not stand. */
  text(robot, sample = this.run.latest) {
    const { run } = this;
    if (run.state(robot, sample) === ABORTED) return `gave up${this.#failure(robot, run.time[sample])}`;
    const reason = this.reason(robot, sample);
    const culprit = this.#culprit(robot, sample);
    if (reason === "robot") return `waits for ${run.names[culprit]}${this.#elsewhere(robot, culprit, sample)} to pass`;
    if (reason === "rotation") return `waits for ${run.names[culprit]}, which moves together with it`;
    if (reason === "blocked") return culprit < 0 ? "stands, though its way is free" : `is blocked near ${run.names[culprit]}`;
    if (reason === "fault") return this.#latest(robot, run.time[sample], ["fault"])?.[3] ?? "is out of order";
    if (reason === "recovery") return this.#recovery(robot, run.time[sample]);
    if (reason !== "resource") return WORDS[reason] ?? "";
    const { kind, name } = run.world.resources[culprit];
    return `waits for ${name.toLowerCase().includes(kind) ? "" : `${kind} `}${name}`;
  }

  /** " on" and the level of a robot that is on another level than its culprit. */
  #elsewhere(robot, culprit, sample) {
    const [own, other] = [robot, culprit].map((one) => this.run.value("level", one, 0, sample));
    return own === other ? "" : ` on ${this.run.levelName(other)}`;
  }

  #recovery(robot, time) {
    const last = this.#latest(robot, time, ["recovery"]);
    return last ? `recovers (${words(last[3])})${this.#failure(robot, time)}` : "recovers";
  }

  /** What went wrong for a robot last, after a colon. */
  #failure(robot, time) {
    const last = this.#latest(robot, time, ["no_progress", "no_command"]);
    return last ? `: ${words(last[3] || last[1])}` : "";
  }

  /** The last event of a robot of some kinds, undefined if there is none. */
  #latest(robot, time, kinds) {
    return this.run.events.findLast(([at, kind, who]) => at <= time && who === robot && kinds.includes(kind));
  }

  /** Where the culprit is on a level now: [x, y], or null. */
  place(robot, level) {
    const { run } = this;
    const culprit = this.#culprit(robot);
    const reason = this.reason(robot);
    if (culprit < 0) return null;
    if (reason === "resource") {
      const found = run.world.resources[culprit].places.find((place) => place[2] === level);
      return found ? found.slice(0, 2) : null;
    }
    return run.value("level", culprit, 0) === level ? [run.pose.x[culprit], run.pose.y[culprit]] : null;
  }

  /** A line from each robot that waits (or from the selected one alone) to its culprit; with an arrow head unless there are many. */
  draw(context, view, theme, shown) {
    const { run } = this;
    const path = new Path2D();
    const crowd = run.count > CROWD && shown.selected < 0;
    for (let robot = 0; robot < run.count; robot++) {
      if (shown.selected >= 0 && shown.selected !== robot) continue;
      if (!this.reason(robot) || run.value("level", robot, 0) !== shown.level) continue;
      const place = this.place(robot, shown.level);
      if (place) arrow(path, view.toScreen(run.pose.x[robot], run.pose.y[robot]), view.toScreen(...place), crowd ? 0 : HEAD);
    }
    context.lineCap = crowd ? "butt" : "round";
    context.lineJoin = crowd ? "bevel" : "round";
    for (const [colour, width] of crowd ? [[theme.ink, 1]] : [[theme.paper, 5], [theme.ink, 1.75]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke(path);
    }
  }
}

const words = (name) => name.replaceAll("_", " ");

function arrow(path, [fromX, fromY], [toX, toY], size) {
  const length = Math.hypot(toX - fromX, toY - fromY);
  if (length < 2) return;
  const [x, y] = [(toX - fromX) / length, (toY - fromY) / length];
  path.moveTo(fromX, fromY);
  path.lineTo(toX, toY);
  if (!size) return;
  const head = Math.min(size, length / 2);
  path.moveTo(toX - head * (x + 0.5 * y), toY - head * (y - 0.5 * x));
  path.lineTo(toX, toY);
  path.lineTo(toX - head * (x - 0.5 * y), toY - head * (y + 0.5 * x));
}
