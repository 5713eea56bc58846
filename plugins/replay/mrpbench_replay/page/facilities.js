// Doors and lifts: the current positions of leaves and cabins.

const AT = 0.02; // metres by which a cabin may miss a level and still be there

export class Facilities {
  constructor(run) {
    this.run = run;
    this.doors = run.world.doors;
    this.cabins = run.world.cabins;
  }

  /** What a facility does now, an opening or a height; what was not recorded is shut, and a cabin at its first stop. */
  #doing(number) {
    const { run } = this;
    const channel = run.arrays.facility;
    if (!channel) return number < this.doors.length ? 0 : this.cabins[number - this.doors.length].stops[0][1];
    const at = number * run.samples + run.sample;
    const next = run.samples > 1 ? at + 1 : at;
    return channel.offset + channel.scale * (channel.values[at] + run.fraction * (channel.values[next] - channel.values[at]));
  }

  height(cabin) {
    return this.#doing(this.doors.length + cabin);
  }

  /** The level of a cabin or, between two, the nearer. */
  level(cabin) {
    const height = this.height(cabin);
    return this.cabins[cabin].stops.reduce((best, stop) => (Math.abs(stop[1] - height) < Math.abs(best[1] - height) ? stop : best))[0];
  }

  /** How far a door is open on a level: a lift's is shut where the cabin is not. */
  opening(door, level) {
    const { lift, opens_on } = this.doors[door];
    if (lift < 0) return this.#doing(door);
    return opens_on.includes(level) && this.level(lift) === level ? this.#doing(door) : 0;
  }

  draw(context, view, theme, shown) {
    context.lineCap = "butt";
    context.lineWidth = Math.max(2.5, 0.06 * view.scale);
    for (const [number, door] of this.doors.entries()) {
      if (!door.levels.includes(shown.level)) continue;
      const opening = this.opening(number, shown.level);
      context.strokeStyle = theme.door;
      context.beginPath();
      for (const leaf of door.leaves) {
        const [from, to] = ends(leaf, opening);
        context.moveTo(...view.toScreen(...from));
        context.lineTo(...view.toScreen(...to));
      }
      context.stroke();
    }
    this.#drawCabins(context, view, theme, shown);
  }

  /** The level at which a cabin is, and an arrow while it moves. */
  #drawCabins(context, view, theme, shown) {
    context.font = "bold 11px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineJoin = "round";
    context.lineWidth = 3;
    context.strokeStyle = theme.lift;
    for (const [number, { x, y, stops }] of this.cabins.entries()) {
      if (!stops.some(([level]) => level === shown.level)) continue;
      const level = this.level(number);
      const off = this.height(number) - stops.find(([stop]) => stop === level)[1];
      const moving = Math.abs(off) > AT;
      const text = `${moving ? "↕ " : ""}${this.run.world.levels[level].name || level}`;
      context.fillStyle = level === shown.level && !moving ? theme.ink : theme.muted;
      const [px, py] = view.toScreen(x, y);
      context.strokeText(text, px, py + 16);
      context.fillText(text, px, py + 16);
    }
  }
}

/** Both ends of a leaf that is open by a share. */
function ends([x1, y1, x2, y2, dx, dy, turn], opening) {
  const [cos, sin] = [Math.cos(turn * opening), Math.sin(turn * opening)];
  const from = [x1 + dx * opening, y1 + dy * opening];
  return [from, [from[0] + cos * (x2 - x1) - sin * (y2 - y1), from[1] + sin * (x2 - x1) + cos * (y2 - y1)]];
}
