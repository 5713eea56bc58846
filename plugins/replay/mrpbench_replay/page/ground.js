// What does not move: grid, walls, obstacles, lifts, lanes, names. Drawn again only when the view changes.

import { decoded } from "replay/data.js";
import { isNarrow } from "replay/surface.js";

const FONT = "11px system-ui, sans-serif";
const MOST_NAMES = 400;

export class Ground {
  constructor(run) {
    this.run = run;
    this.levels = run.world.levels.map((level, number) => {
      const walls = new Path2D();
      const corners = decoded(run.arrays[`walls_${number}`]);
      for (let i = 0; i < corners.length; i += 8) {
        walls.moveTo(corners[i], corners[i + 1]);
        for (let k = 2; k < 8; k += 2) walls.lineTo(corners[i + k], corners[i + k + 1]);
        walls.closePath();
      }
      const lifts = run.world.lifts.filter(([, , levels]) => levels.includes(number));
      return {
        walls,
        floors: outlines(level.floors),
        holes: outlines(level.holes),
        obstacles: outlines(level.obstacles.map(([, polygon]) => polygon)),
        lifts: outlines(lifts.map(([, polygon]) => polygon)),
        raster: null,
        colour: "",
      };
    });
    this.lanes = run.world.levels.map((_, number) => {
      const path = new Path2D();
      for (const [from, to] of this.#lanesOf(number)) {
        path.moveTo(from[0], from[1]);
        path.lineTo(to[0], to[1]);
      }
      return path;
    });
  }

  #lanesOf(level) {
    const { lanes, vertices } = this.run.world;
    return lanes
      .map(([from, to, both]) => [vertices[from], vertices[to], both])
      .filter(([from, to]) => from[2] === level && to[2] === level);
  }

  draw(context, view, theme, shown) {
    context.fillStyle = theme.paper;
    context.fillRect(0, 0, view.width, view.height);
    const level = this.levels[shown.level];
    inMetres(context, view, () => {
      context.fillStyle = theme.floor;
      context.fill(level.floors);
      context.fillStyle = theme.paper;
      context.fill(level.holes);
    });
    drawGrid(context, view, theme);
    this.#drawRaster(context, view, theme, shown.level);
    inMetres(context, view, () => {
      context.lineWidth = 1 / view.scale;
      context.fillStyle = theme.lift;
      context.strokeStyle = theme.place;
      context.fill(level.lifts);
      context.stroke(level.lifts);
      context.setLineDash([4 / view.scale, 3 / view.scale]);
      context.stroke(level.holes);
      context.setLineDash([]);
      context.fillStyle = theme.obstacle;
      context.strokeStyle = theme.wall;
      context.fill(level.obstacles);
      context.stroke(level.obstacles);
      if (shown.layers.lanes) {
        context.strokeStyle = theme.lane;
        context.lineWidth = 1.25 / view.scale;
        context.stroke(this.lanes[shown.level]);
      }
      context.fillStyle = context.strokeStyle = theme.wall;
      context.lineWidth = 0.75 / view.scale;
      context.fill(level.walls);
      context.stroke(level.walls);
    });
    if (shown.layers.lanes) {
      this.#drawArrows(context, view, theme, shown.level);
      this.#drawPlaces(context, view, theme, shown.level);
    }
    if (shown.layers.names) this.#drawNames(context, view, theme, shown.level);
    drawScale(context, view, theme);
  }

  #drawRaster(context, view, theme, number) {
    const { raster } = this.run.world.levels[number];
    if (!raster) return;
    const kept = this.levels[number];
    const { values, shape } = this.run.arrays[`blocked_${number}`];
    if (kept.colour !== theme.wall) {
      kept.raster = paintCells(values, shape, theme.wall);
      kept.colour = theme.wall;
    }
    const [left, bottom] = view.toScreen(...raster.origin);
    const size = raster.cell * view.scale;
    const area = [left, bottom - shape[0] * size, shape[1] * size, shape[0] * size];
    context.imageSmoothingEnabled = size < 1;
    context.fillStyle = theme.floor;
    context.fillRect(...area);
    context.drawImage(kept.raster, ...area);
    context.strokeStyle = theme.wall; // beyond its edge a raster is solid
    context.lineWidth = 2;
    context.strokeRect(area[0] - 1, area[1] - 1, area[2] + 2, area[3] + 2);
  }

  /** Arrow heads in the middle of one-way lanes. */
  #drawArrows(context, view, theme, number) {
    context.fillStyle = theme.lane;
    context.beginPath();
    for (const [from, to, both] of this.#lanesOf(number)) {
      const [x, y] = view.toScreen((from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
      if (both || x < 0 || y < 0 || x > view.width || y > view.height) continue;
      const angle = Math.atan2(from[1] - to[1], to[0] - from[0]);
      for (const [turn, reach] of [[0, 6], [2.5, 5], [-2.5, 5]]) {
        context[turn === 0 ? "moveTo" : "lineTo"](x + reach * Math.cos(angle + turn), y + reach * Math.sin(angle + turn));
      }
    }
    context.fill();
  }

  #drawPlaces(context, view, theme, number) {
    const radius = Math.min(Math.max(view.scale * 0.06, 1.2), 4);
    context.fillStyle = theme.paper;
    context.strokeStyle = theme.place;
    context.lineWidth = 1.25;
    context.beginPath();
    for (const [x, y, level] of this.run.world.vertices) {
      const [px, py] = view.toScreen(x, y);
      if (level !== number || px < -9 || py < -9 || px > view.width + 9 || py > view.height + 9) continue;
      context.moveTo(px + radius, py);
      context.arc(px, py, radius, 0, 2 * Math.PI);
    }
    context.fill();
    context.stroke();
  }

  /** Each name above, below or beside its place; one that fits nowhere is left out. */
  #drawNames(context, view, theme, number) {
    context.font = FONT;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = 3;
    context.strokeStyle = theme.paper;
    context.fillStyle = theme.name;
    const taken = [];
    const written = new Set(); // one place of several lane graphs has its name once
    for (const [x, y, level, name] of this.run.world.vertices) {
      const place = `${x} ${y} ${name}`;
      if (!name || level !== number || written.has(place) || taken.length >= MOST_NAMES) continue;
      written.add(place);
      const [px, py] = view.toScreen(x, y);
      if (px < 0 || py < 0 || px > view.width || py > view.height) continue;
      const text = name.replaceAll("_", " ");
      const half = context.measureText(text).width / 2 + 2;
      for (const [dx, dy] of [[0, -13], [0, 13], [half + 8, 0], [-half - 8, 0]]) {
        const box = [px + dx - half, py + dy - 7, px + dx + half, py + dy + 7];
        if (box[0] < 0 || box[2] > view.width) continue; // it would be cut off
        if (taken.some((other) => box[0] < other[2] && box[2] > other[0] && box[1] < other[3] && box[3] > other[1])) continue;
        taken.push(box);
        context.strokeText(text, px + dx, py + dy);
        context.fillText(text, px + dx, py + dy);
        break;
      }
    }
  }
}

/** Polygons of points as one path. */
function outlines(polygons) {
  const path = new Path2D();
  for (const polygon of polygons) {
    polygon.forEach(([x, y], index) => (index ? path.lineTo(x, y) : path.moveTo(x, y)));
    path.closePath();
  }
  return path;
}

/** Draw in world coordinates. */
function inMetres(context, view, draw) {
  context.save();
  context.translate(view.width / 2 - view.x * view.scale, view.height / 2 + view.y * view.scale);
  context.scale(view.scale, -view.scale);
  draw();
  context.restore();
}

/** One pixel per cell; row 0 of a raster is its lowest. */
function paintCells(values, [rows, columns], colour) {
  const canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext("2d");
  context.fillStyle = colour;
  context.fillRect(0, 0, columns, rows);
  const image = context.getImageData(0, 0, columns, rows);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      image.data[4 * ((rows - 1 - row) * columns + column) + 3] = values[row * columns + column] ? 255 : 0;
    }
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/** A length of 1, 2 or 5 times a power of ten that takes at least `pixels`. */
function roundLength(view, pixels) {
  const power = 10 ** Math.floor(Math.log10(pixels / view.scale));
  return [1, 2, 5, 10].map((digit) => digit * power).find((length) => length * view.scale >= pixels);
}

function drawGrid(context, view, theme) {
  const step = roundLength(view, 40);
  const [left, top] = view.toWorld(0, 0);
  const [right, bottom] = view.toWorld(view.width, view.height);
  context.strokeStyle = theme.grid;
  context.lineWidth = 1;
  context.beginPath();
  for (let x = Math.ceil(left / step) * step; x <= right; x += step) {
    const px = Math.round(view.toScreen(x, 0)[0]) + 0.5;
    context.moveTo(px, 0);
    context.lineTo(px, view.height);
  }
  for (let y = Math.ceil(bottom / step) * step; y <= top; y += step) {
    const py = Math.round(view.toScreen(0, y)[1]) + 0.5;
    context.moveTo(0, py);
    context.lineTo(view.width, py);
  }
  context.stroke();
}

function drawScale(context, view, theme) {
  if (isNarrow()) return;
  const length = roundLength(view, 60);
  const right = view.width - 132; // left of the buttons
  const left = right - length * view.scale;
  const y = view.height - 20;
  context.strokeStyle = context.fillStyle = theme.muted;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(left, y - 5);
  context.lineTo(left, y);
  context.lineTo(right, y);
  context.lineTo(right, y - 5);
  context.stroke();
  context.font = FONT;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(length < 1 ? `${Math.round(length * 100)} cm` : `${length} m`, (left + right) / 2, y - 3);
}
