// Simulated time: runs, stops and is set.

export const SPEEDS = [0.5, 1, 2, 5, 10, 20, 50];
const WATCHABLE = 40; // seconds that the whole run should take at first

export class Clock extends EventTarget {
  constructor(begin, end) {
    super();
    this.begin = begin;
    this.end = end;
    this.now = begin;
    this.playing = false;
    this.speed = SPEEDS.find((speed) => (end - begin) / speed <= WATCHABLE) ?? SPEEDS.at(-1);
  }

  #changed() {
    this.dispatchEvent(new Event("change"));
  }

  seek(time) {
    this.now = Math.min(Math.max(time, this.begin), this.end);
    this.#changed();
  }

  /** Play or pause; at the end, play from the start. */
  toggle(playing = !this.playing) {
    this.playing = playing;
    if (playing && this.now >= this.end) this.now = this.begin;
    this.#changed();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.#changed();
  }

  /** The next higher or lower of the speeds on offer. */
  shift(by) {
    const at = SPEEDS.indexOf(this.speed) + by;
    if (SPEEDS[at]) this.setSpeed(SPEEDS[at]);
  }

  /** Go on by real seconds. */
  advance(seconds) {
    if (!this.playing) return;
    this.now = Math.min(this.now + seconds * this.speed, this.end);
    if (this.now >= this.end) this.playing = false;
    this.#changed();
  }
}

/** Seconds between the labels of an axis of `width` pixels. */
export function timeStep(begin, end, width) {
  const steps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600];
  return steps.find((step) => ((end - begin) / step) * 56 < width) ?? 7200;
}

/** Seconds as minutes, seconds and tenths. */
export function clockText(seconds) {
  const tenths = Math.round(seconds * 10);
  const minutes = Math.floor(tenths / 600);
  return `${minutes}:${((tenths - minutes * 600) / 10).toFixed(1).padStart(4, "0")}`;
}
