// Robots in their true footprint, with heading; contacts; numbers.

import { RIMS } from "replay/colours.js";

const LEAST = { few: 6, many: 3 }; // pixels of radius: smaller robots are drawn this large, so that they can be seen
const NUMBERED = 9; // pixels of radius from which every robot gets its number
const FEW = 60; // robots that always get their numbers
const EDGE = 0.6; // pixels by which bodies are larger than the footprint, instead of outlines, which are slow
const POINTER = [[2.2, 0], [0, 0.3], [0, -0.3]]; // heading of a robot too small for an arrow head, in radii
const FLASH = 1; // seconds that a contact goes on to be shown

export class Robots {
  constructor(run) {
    this.run = run;
    this.least = run.count <= FEW ? LEAST.few : LEAST.many;
    this.visible = new Int32Array(run.count);
    this.visibleCount = 0;
    this.px = new Float64Array(run.count);
    this.py = new Float64Array(run.count);
  }

  draw(context, view, theme, shown, colours, calm) {
    this.#place(view, shown);
    if (shown.layers.estimate && this.run.ghost) this.#drawGhosts(context, view, shown, colours);
    this.#drawBodies(context, view, theme, colours);
    this.#drawContacts(context, view, theme, calm);
    this.#drawNumbers(context, view, theme, shown);
    if (shown.selected >= 0) this.#drawSelected(context, view, theme, shown);
  }

  /** Find the robots that are on the screen, and where. */
  #place(view, shown) {
    const { run } = this;
    const { x, y } = run.pose;
    this.visibleCount = 0;
    for (let robot = 0; robot < run.count; robot++) {
      const px = (this.px[robot] = (x[robot] - view.x) * view.scale + view.width / 2);
      const py = (this.py[robot] = view.height / 2 - (y[robot] - view.y) * view.scale);
      const reach = run.model(robot).radius * view.scale + this.least;
      if (px < -reach || py < -reach || px > view.width + reach || py > view.height + reach) continue;
      if (run.value("level", robot, 0) !== shown.level || !run.isKnown(robot)) continue;
      this.visible[this.visibleCount++] = robot;
    }
  }

  /** Pixels per metre of a robot's own shape. */
  #zoomed(robot, view) {
    return Math.max(view.scale, this.least / this.run.model(robot).radius);
  }

  #drawBodies(context, view, theme, colours) {
    const { run } = this;
    const bodies = colours.palette.map(() => new Path2D());
    const used = new Set();
    const noses = new Path2D();
    const rims = RIMS.map(() => new Path2D());
    for (let i = 0; i < this.visibleCount; i++) {
      const robot = this.visible[i];
      const { footprint, radius } = run.model(robot);
      const scale = this.#zoomed(robot, view);
      const colour = colours.of(robot);
      used.add(colour);
      outline(bodies[colour], footprint, this.px[robot], this.py[robot], run.pose.yaw[robot], scale + EDGE / radius);
      if (colours.rim(robot)) outline(rims[colours.rim(robot)], footprint, this.px[robot], this.py[robot], run.pose.yaw[robot], scale + 1.5 / radius);
      if (radius * scale >= 5) nose(noses, footprint, this.px[robot], this.py[robot], run.pose.yaw[robot], scale);
      else outline(bodies[colour], POINTER, this.px[robot], this.py[robot], run.pose.yaw[robot], radius * scale);
    }
    for (const colour of used) {
      context.fillStyle = colours.palette[colour];
      context.fill(bodies[colour]);
    }
    context.lineJoin = "round";
    context.fillStyle = theme.nose;
    context.fill(noses);
    rims.forEach((rim, index) => {
      for (const [colour, width, dash] of RIMS[index]) {
        context.strokeStyle = theme[colour];
        context.lineWidth = width;
        context.setLineDash(dash);
        context.stroke(rim);
      }
    });
    context.setLineDash([]);
  }

  #drawGhosts(context, view, shown, colours) {
    const { run } = this;
    context.lineWidth = 1.25;
    context.setLineDash([3, 2]);
    for (let i = 0; i < this.visibleCount; i++) {
      const robot = this.visible[i];
      const [px, py] = view.toScreen(run.ghost.x[robot], run.ghost.y[robot]);
      const path = new Path2D();
      outline(path, run.model(robot).footprint, px, py, run.ghost.yaw[robot], this.#zoomed(robot, view) * 1.15);
      context.strokeStyle = colours.palette[colours.of(robot)];
      context.stroke(path);
    }
    context.setLineDash([]);
  }

  /** Rings that widen while robots touch; static rings for readers who prefer reduced motion. */
  #drawContacts(context, view, theme, calm) {
    const { run } = this;
    context.strokeStyle = theme.alarm;
    for (const [first, last, ...pair] of run.touching(FLASH)) {
      const fade = run.now <= last ? 1 : 1 - (run.now - last) / FLASH;
      const phase = calm ? 0.5 : ((run.now - first) * 1.5) % 1;
      for (const robot of pair) {
        if (robot < 0 || robot >= run.count) continue;
        const radius = Math.max(run.model(robot).radius * view.scale, this.least) + 4;
        context.lineWidth = 3;
        context.globalAlpha = fade;
        ring(context, this.px[robot], this.py[robot], radius);
        context.globalAlpha = fade * (1 - phase);
        ring(context, this.px[robot], this.py[robot], radius + 18 * phase);
      }
    }
    context.globalAlpha = 1;
  }

  #drawSelected(context, view, theme, shown) {
    const robot = shown.selected;
    if (this.run.value("level", robot, 0) !== shown.level) return;
    const radius = Math.max(this.run.model(robot).radius * view.scale, this.least) + 6;
    context.strokeStyle = theme.ink;
    context.lineWidth = 2.5;
    ring(context, this.px[robot], this.py[robot], radius);
    letter(context, theme, "center");
    write(context, this.run.names[robot], this.px[robot], this.py[robot] - radius - 10);
  }

  #drawNumbers(context, view, theme, shown) {
    const { run } = this;
    letter(context, theme, "left");
    for (let i = 0; i < this.visibleCount; i++) {
      const robot = this.visible[i];
      const radius = Math.max(run.model(robot).radius * view.scale, this.least);
      if (robot === shown.selected || (run.count > FEW && radius < NUMBERED)) continue;
      write(context, String(robot), this.px[robot] + radius + 4, this.py[robot] - radius);
    }
  }

  /** The robot drawn nearest to a pixel, -1 if none is close. */
  at(px, py, view, slack = 8) {
    let best = -1;
    let least = Infinity;
    for (let i = 0; i < this.visibleCount; i++) {
      const robot = this.visible[i];
      const distance = Math.hypot(this.px[robot] - px, this.py[robot] - py);
      const reach = Math.max(this.run.model(robot).radius * view.scale, this.least) + slack;
      if (distance < reach && distance < least) [best, least] = [robot, distance];
    }
    return best;
  }
}

function outline(path, polygon, px, py, yaw, scale) {
  const [cos, sin] = [scale * Math.cos(yaw), scale * Math.sin(yaw)];
  polygon.forEach(([x, y], index) => {
    const [sx, sy] = [px + x * cos - y * sin, py - x * sin - y * cos];
    if (index) path.lineTo(sx, sy);
    else path.moveTo(sx, sy);
  });
  path.closePath();
}

/** An arrow head inside the footprint. */
function nose(path, footprint, px, py, yaw, scale) {
  const front = Math.max(...footprint.map(([x]) => x));
  const rear = Math.min(...footprint.map(([x]) => x));
  const half = 0.6 * Math.max(...footprint.map(([, y]) => y));
  const length = front - rear;
  const tip = front - 0.1 * length;
  const back = rear + 0.22 * length;
  outline(path, [[tip, 0], [back, half], [back + 0.22 * length, 0], [back, -half]], px, py, yaw, scale);
}

function letter(context, theme, align) {
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = align;
  context.textBaseline = "middle";
  context.lineWidth = 3;
  context.lineJoin = "round";
  context.strokeStyle = theme.paper;
  context.fillStyle = theme.ink;
}

function write(context, text, x, y) {
  context.strokeText(text, x, y);
  context.fillText(text, x, y);
}

function ring(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
}
