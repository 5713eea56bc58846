// People and other movers: their discs, and where they look.

const LEAST = 3; // pixels of radius

export class People {
  constructor(run) {
    this.run = run;
  }

  draw(context, view, theme, shown) {
    const { run } = this;
    if (!run.movers.length) return;
    const discs = new Path2D();
    const noses = new Path2D();
    const { mover_x: xs, mover_y: ys, mover_yaw: yaws, mover_level: levels } = run.arrays;
    run.movers.forEach(({ radius }, mover) => {
      if (levels.values[mover * run.samples + run.latest] !== shown.level) return;
      const [px, py] = view.toScreen(run.between(xs, mover), run.between(ys, mover));
      const size = Math.max(radius * view.scale, LEAST);
      if (px < -size || py < -size || px > view.width + size || py > view.height + size) return;
      const yaw = run.between(yaws, mover);
      discs.moveTo(px + size, py);
      discs.arc(px, py, size, 0, 2 * Math.PI);
      noses.moveTo(px, py);
      noses.lineTo(px + size * Math.cos(yaw), py - size * Math.sin(yaw));
    });
    context.fillStyle = theme.paper;
    context.fill(discs);
    context.strokeStyle = theme.ink;
    context.lineWidth = 1.5;
    context.stroke(discs);
    context.stroke(noses);
  }
}
