// Scans, read only when the reader switches them on.

import { decoded, lastAtMost, readArrays } from "replay/data.js";

const MOST = 20; // robots whose scans are drawn together
const FRESH = 1; // seconds that a scan is shown at least

export class Lidar {
  constructor(run, thinning) {
    this.run = run;
    this.thinning = thinning;
    this.arrays = null;
    this.reading = null;
  }

  /** Read the scans, once. */
  read() {
    this.reading ??= readArrays("scans").then((arrays) => {
      this.time = decoded(arrays.scan_time);
      const robots = arrays.scan_robot.values;
      this.first = Array.from({ length: this.run.count + 1 }, (_, robot) => lastAtMost(robots, robot - 1) + 1);
      this.arrays = arrays;
    });
    return this.reading;
  }

  draw(context, view, shown, colours) {
    if (!this.arrays) return;
    if (shown.selected >= 0) this.#drawScan(context, view, shown, colours, shown.selected);
    else if (this.run.count <= MOST) {
      for (let robot = 0; robot < this.run.count; robot++) this.#drawScan(context, view, shown, colours, robot);
    }
  }

  /** The newest scan of a robot, about where the robot was when it was taken. */
  #drawScan(context, view, shown, colours, robot) {
    const { run } = this;
    const { lidar } = run.model(robot);
    const [first, end] = [this.first[robot], this.first[robot + 1]];
    const scan = lastAtMost(this.time, run.now, first, end);
    if (!lidar || scan < first || run.value("level", robot, 0) !== shown.level) return;
    const gap = end - first > 1 ? (this.time[end - 1] - this.time[first]) / (end - first - 1) : 0;
    if (run.now - this.time[scan] > Math.max(FRESH, 1.5 * gap)) return;
    const { x, y, yaw } = this.#poseAt(robot, this.time[scan]);
    const [mx, my] = lidar.mount;
    const cx = x + mx * Math.cos(yaw) - my * Math.sin(yaw);
    const cy = y + mx * Math.sin(yaw) + my * Math.cos(yaw);
    const { values, shape, scale } = this.arrays.scan_ranges;
    const area = new Path2D();
    const hits = new Path2D();
    const step = (2 * Math.PI * this.thinning.beam_step) / lidar.beams;
    for (let beam = 0; beam * this.thinning.beam_step < lidar.beams; beam++) {
      const steps = values[scan * shape[1] + beam];
      const range = steps ? steps * scale : lidar.range;
      const angle = yaw + beam * step;
      const [px, py] = view.toScreen(cx + range * Math.cos(angle), cy + range * Math.sin(angle));
      area.lineTo(px, py);
      if (steps) hits.rect(px - 1.25, py - 1.25, 2.5, 2.5);
    }
    area.closePath();
    context.fillStyle = colours.palette[colours.of(robot)];
    context.globalAlpha = 0.13;
    context.fill(area);
    context.globalAlpha = 0.9;
    context.fill(hits);
    context.globalAlpha = 1;
  }

  #poseAt(robot, time) {
    const { run } = this;
    const sample = Math.min(Math.max(lastAtMost(run.time, time), 0), Math.max(run.samples - 2, 0));
    const next = Math.min(sample + 1, run.samples - 1);
    const share = next > sample ? (time - run.time[sample]) / (run.time[next] - run.time[sample]) : 0;
    const at = (axis) => {
      const { values, scale, offset } = run.arrays[axis];
      const [here, there] = [values[robot * run.samples + sample], values[robot * run.samples + next]];
      return offset + scale * (here + share * (there - here));
    };
    return { x: at("x"), y: at("y"), yaw: at("yaw") };
  }
}
