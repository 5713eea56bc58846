// Which part of the world is on the screen: metres, y up, to pixels, y down.

const MOST = 2000; // pixels per metre

export class View {
  constructor(bounds) {
    this.bounds = bounds;
    this.width = this.height = 1;
    this.x = this.y = 0; // metres at the centre
    this.scale = 1; // pixels per metre
    this.fitted = true;
    this.inset = { left: 0, right: 0, top: 0, bottom: 0 };
  }

  resize(width, height) {
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
    if (this.fitted) this.fit();
  }

  /** Show everything, clear of the controls that lie over the map. */
  fit() {
    const [left, bottom, right, top] = this.bounds;
    const { inset } = this;
    const across = Math.max(this.width - inset.left - inset.right, 50);
    const up = Math.max(this.height - inset.top - inset.bottom, 50);
    this.scale = Math.min(across / (right - left), up / (top - bottom));
    this.x = (left + right) / 2 + (inset.right - inset.left) / 2 / this.scale;
    this.y = (bottom + top) / 2 + (inset.top - inset.bottom) / 2 / this.scale;
    this.fitted = true;
  }

  /** Enlarge about a pixel, which keeps showing the same place. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const least = Math.min(this.width / (this.bounds[2] - this.bounds[0]), this.height / (this.bounds[3] - this.bounds[1]));
    const scale = Math.min(Math.max(this.scale * factor, least / 4), MOST);
    const [x, y] = this.toWorld(px, py);
    this.scale = scale;
    this.x = x - (px - this.width / 2) / scale;
    this.y = y + (py - this.height / 2) / scale;
    this.fitted = false;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.fitted = false;
  }

  centre(x, y) {
    this.x = x;
    this.y = y;
    this.fitted = false;
  }

  toWorld(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  toScreen(x, y) {
    return [(x - this.x) * this.scale + this.width / 2, this.height / 2 - (y - this.y) * this.scale];
  }
}
